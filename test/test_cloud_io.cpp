// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io_support.h"
#include "io/cloud_io.h"
#include "io/file.h"
#include "io/pcd.h"
#include "io/pcl_cloud.h"
#include "io/ply.h"
#include "io/text.h"
#include "support/foreign_locale.h"
#include "support/temporary_folder.h"

#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>
#include <pcl/point_types.h>

#include <cmath>
#include <filesystem>
#include <limits>

namespace fs = std::filesystem;

namespace pcl_flashreg::io {
namespace {

class PclFiles : public FolderTest {
protected:
  void
  SetUp() override
  {
    FolderTest::SetUp();
    made::Random random(3);
    for (int i = 0; i < 500; ++i) {
      pcl::PointXYZRGBNormal p;
      p.getVector3fMap() = random.inCube(5).cast<float>();
      p.getNormalVector3fMap() = random.inCube(1).normalized().cast<float>();
      p.curvature = 0.25f;
      p.r = static_cast<std::uint8_t>(i % 256);
      p.g = 7;
      p.b = 250;
      points_.push_back(p);
    }
  }

  void
  expectSamePoints(const Cloud& cloud) const
  {
    ASSERT_EQ(cloud.size(), points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      EXPECT_NEAR(valueOf(cloud, i, "x"), points_[i].x, 1e-5);
      EXPECT_NEAR(valueOf(cloud, i, "normal_z"), points_[i].normal_z, 1e-5);
      EXPECT_NEAR(valueOf(cloud, i, "curvature"), points_[i].curvature, 1e-5);
    }
  }

  pcl::PointCloud<pcl::PointXYZRGBNormal> points_;
};

TEST_F(PclFiles, pcdThatPclWrites)
{
  pcl::PCDWriter writer;
  ASSERT_EQ(writer.writeASCII(path("ascii.pcd"), points_), 0);
  ASSERT_EQ(writer.writeBinary(path("binary.pcd"), points_), 0);
  ASSERT_EQ(writer.writeBinaryCompressed(path("compressed.pcd"), points_), 0);
  for (const char* name : {"ascii.pcd", "binary.pcd", "compressed.pcd"}) {
    const Cloud cloud = readCloud(path(name));
    expectSamePoints(cloud);
    std::uint8_t color[4];
    std::memcpy(color, cloud.point(3) + cloud.find("rgb")->offset, 4);
    EXPECT_EQ(color[0], 250) << name;
    EXPECT_EQ(color[1], 7) << name;
    EXPECT_EQ(color[2], 3) << name;
  }
}

TEST_F(PclFiles, plyThatPclWrites)
{
  pcl::PLYWriter writer;
  pcl::PCLPointCloud2 blob;
  pcl::toPCLPointCloud2(points_, blob);
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
  ASSERT_EQ(writer.writeASCII(path("a.ply"), blob, origin, rotation), 0);
  ASSERT_EQ(writer.writeBinary(path("b.ply"), blob, origin, rotation), 0);
  expectSamePoints(readCloud(path("a.ply")));
  expectSamePoints(readCloud(path("b.ply")));
}

TEST_F(PclFiles, pclReadsWhatIsWritten)
{
  ASSERT_EQ(pcl::PCDWriter().writeBinary(path("in.pcd"), points_), 0);
  const Cloud cloud = readCloud(path("in.pcd"));
  writeCloud(path("out.pcd"), cloud);
  writeCloud(path("out.ply"), cloud);
  pcl::PointCloud<pcl::PointXYZRGBNormal> from_pcd, from_ply;
  ASSERT_EQ(pcl::io::loadPCDFile(path("out.pcd"), from_pcd), 0);
  ASSERT_EQ(pcl::io::loadPLYFile(path("out.ply"), from_ply), 0);
  ASSERT_EQ(from_pcd.size(), points_.size());
  ASSERT_EQ(from_ply.size(), points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i)
    for (const auto* read : {&from_pcd[i], &from_ply[i]}) {
      EXPECT_EQ(read->getVector3fMap(), points_[i].getVector3fMap());
      EXPECT_EQ(read->getNormalVector3fMap(), points_[i].getNormalVector3fMap());
      EXPECT_EQ(read->r, points_[i].r);
      EXPECT_EQ(read->g, points_[i].g);
      EXPECT_EQ(read->b, points_[i].b);
    }
}

TEST(Text, numbersThatAreNotFinite)
{
  const double infinity = std::numeric_limits<double>::infinity();
  const auto parsed = [](const std::string& word) {
    double value = 0;
    return parseDouble(word, value) ? value : 0;
  };
  for (const char* word : {"nan",
                           "-nan",
                           "+nan",
                           "NaN",
                           "nan(ind)",
                           "-nan(ind)",
                           "nan(snan)",
                           "1.#QNAN",
                           "-1.#IND",
                           "1.#QNAN00",
                           "1.#SNAN"})
    EXPECT_TRUE(std::isnan(parsed(word))) << word;
  for (const char* word : {"inf", "Inf", "+inf", "Infinity", "1.#INF", "1.#INF00"})
    EXPECT_EQ(parsed(word), infinity) << word;
  for (const char* word : {"-inf", "-Infinity", "-1.#INF"})
    EXPECT_EQ(parsed(word), -infinity) << word;
  for (const char* word : {"", "-", "nanometre", "2.#INF", "1#INF", "in", "1.5x"})
    EXPECT_EQ(parsed(word), 0) << word;
}

TEST(Cloud, storesTheNearestValue)
{
  std::uint8_t point[8];
  const auto stored = [&](ScalarType type, double value) {
    const Field field{"f", type, 1, 0};
    storeValue(point, field, value);
    return loadValue(point, field);
  };
  EXPECT_EQ(stored(ScalarType::Uint8, 300), 255);
  EXPECT_EQ(stored(ScalarType::Uint8, -3), 0);
  EXPECT_EQ(stored(ScalarType::Int16, -1e9), -32768);
  EXPECT_EQ(stored(ScalarType::Int32, 2.6), 3);
  EXPECT_EQ(stored(ScalarType::Int32, std::nan("")), 0);
  EXPECT_EQ(stored(ScalarType::Int64, 1e300), 9223372036854775807.0);
  EXPECT_EQ(stored(ScalarType::Float32, 1e300),
            std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(stored(ScalarType::Float32, std::nan(""))));
}

TEST(Cloud, transformMovesPointsAndViewpointAndTurnsNormals)
{
  Cloud cloud;
  for (const char* name : {"x", "y", "z", "normal_x", "normal_y", "normal_z"})
    cloud.addField(name, name[0] == 'x' ? ScalarType::Float64 : ScalarType::Float32);
  cloud.addField("intensity", ScalarType::Uint16);
  cloud.width = 1;
  cloud.data.resize(cloud.point_size);
  const double values[] = {1, 2, 3, 1, 0, 0, 77};
  for (std::size_t f = 0; f < 7; ++f)
    storeValue(cloud.point(0), cloud.fields[f], values[f]);
  RigidTransform T;
  T.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  T.translation << 10, 20, 30;
  cloud.viewpoint = {1, 2, 3, 0.6, 0.8, 0, 0};
  transformCloud(cloud, T);
  const double half = std::sqrt(0.5);
  const double viewpoint[] = {
      8, 21, 33, 0.6 * half, 0.8 * half, 0.8 * half, 0.6 * half};
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_NEAR(cloud.viewpoint[i], viewpoint[i], 1e-12) << i;
  const double expected[] = {8, 21, 33, 0, 1, 0, 77};
  for (std::size_t f = 0; f < 7; ++f)
    EXPECT_EQ(loadValue(cloud.point(0), cloud.fields[f]), expected[f]);
  EXPECT_EQ(cloud.find("x")->type, ScalarType::Float64);
  EXPECT_EQ(cloud.find("y")->type, ScalarType::Float32);
}

TEST(Cloud, integerCoordinatesBecomeFloatingPoint)
{
  Cloud cloud;
  cloud.addField("x", ScalarType::Int16);
  cloud.addField("y", ScalarType::Int32);
  cloud.addField("z", ScalarType::Uint8);
  cloud.width = 1;
  cloud.data.resize(cloud.point_size);
  RigidTransform T;
  T.translation << 0.5, 0.25, 0.125;
  transformCloud(cloud, T);
  EXPECT_EQ(valueOf(cloud, 0, "x"), 0.5);
  EXPECT_EQ(valueOf(cloud, 0, "y"), 0.25);
  EXPECT_EQ(cloud.find("y")->type, ScalarType::Float64);
  EXPECT_EQ(valueOf(cloud, 0, "z"), 0.125);
}

TEST(PclCloud, shiftsOnlyWhatIsFarFromTheOrigin)
{
  Eigen::Matrix3Xd xyz(3, 3);
  xyz << 0, 10, std::nan(""), 0, 20, 0, 0, 30, 0;
  EXPECT_EQ(toPclCloud(xyz).shift, Eigen::Vector3d::Zero());
  EXPECT_FALSE(needsDoublePrecision(xyz));
  const Eigen::Vector3d utm(500000, 4000000, 300);
  const Eigen::Matrix3Xd far = xyz.colwise() + utm;
  EXPECT_TRUE(needsDoublePrecision(far));
  const ShiftedCloud shifted = toPclCloud(far);
  ASSERT_EQ(shifted.points->size(), 3u);
  EXPECT_NE(shifted.shift, Eigen::Vector3d::Zero());
  const Eigen::Vector3d back =
      (*shifted.points)[1].getVector3fMap().cast<double>() + shifted.shift;
  EXPECT_LT((back - far.col(1)).norm(), 1e-6);
  EXPECT_TRUE(std::isnan((*shifted.points)[2].x));
}

TEST(Files, whatTheyAreIsToldByTheirFirstBytes)
{
  const fs::path folder = fs::temp_directory_path() / "pcl_flashreg_first_bytes";
  fs::create_directories(folder);
  const Cloud cloud = richCloud(50);
  for (const char* name : {"ply.bin", "ply.pcd", "ply.cloud", "pcd.bin", "pcd.ply"}) {
    const std::string path = (folder / name).string();
    writeFile(path, name[1] == 'l' ? formatPly(cloud) : formatPcd(cloud));
    EXPECT_EQ(readCloud(path).data, cloud.data) << name;
  }
  fs::remove_all(folder);
}

TEST(Files, areTheSameInEveryLocale)
{
  Cloud cloud;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, ScalarType::Float32);
  cloud.width = 12345;
  cloud.data.resize(cloud.width * cloud.point_size);
  cloud.viewpoint = {1234.5, -0.25, 0, 1, 0, 0, 0};
  const std::string pcd = formatPcd(cloud), ply = formatPly(cloud);
  const std::string ascii =
      "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 1\n"
      "HEIGHT 1\nVIEWPOINT 0.5 0 0 1 0 0 0\nPOINTS 1\nDATA ascii\n1234.5 -0.25 3\n";
  const test::ForeignLocale abroad;
  EXPECT_EQ(formatPcd(cloud), pcd);
  EXPECT_EQ(formatPly(cloud), ply);
  EXPECT_EQ(parsePcd(pcd).viewpoint, cloud.viewpoint);
  EXPECT_EQ(parsePly(ply).size(), cloud.size());
  const Cloud read = parsePcd(ascii);
  EXPECT_EQ(read.viewpoint[0], 0.5);
  EXPECT_EQ(coordinates(read).col(0), Eigen::Vector3d(1234.5, -0.25, 3));
  EXPECT_EQ(extensionOf("SCAN.BIN"), ".bin");
}

TEST(Files, aFailedWriteLosesNothing)
{
  const fs::path folder = fs::temp_directory_path() / "pcl_flashreg_files";
  fs::create_directories(folder);
  const std::string path = (folder / "kept.pcd").string();
  writeFile(path, "precious");
  Cloud unwritable;
  unwritable.addField("stamp", ScalarType::Uint64);
  EXPECT_THROW(writeCloud((folder / "kept.ply").string(), unwritable), InputError);
  EXPECT_FALSE(fs::exists(folder / "kept.ply"));
  EXPECT_THROW(writeFile((folder / "no" / "folder.pcd").string(), "x"), InputError);
  EXPECT_THROW(writeFile(folder.string(), "x"), InputError);
  EXPECT_EQ(readFile(path), "precious");
  writeFile(path, "new");
  EXPECT_EQ(readFile(path), "new");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  fs::remove_all(folder);
}

TEST(Files, aLinkStaysALink)
{
  const fs::path folder = fs::temp_directory_path() / "pcl_flashreg_link";
  fs::remove_all(folder);
  fs::create_directories(folder);
  writeFile((folder / "real.txt").string(), "old");
  fs::create_symlink("real.txt", folder / "link.txt");
  writeFile((folder / "link.txt").string(), "new");
  EXPECT_TRUE(fs::is_symlink(folder / "link.txt"));
  EXPECT_EQ(readFile((folder / "real.txt").string()), "new");
  fs::remove_all(folder);
}

} // namespace
} // namespace pcl_flashreg::io
