// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud_io_support.h"
#include "io/cloud_io.h"
#include "io/file.h"
#include "map/merged_cloud.h"
#include "support/temporary_folder.h"

#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace pcl_flashreg::map {
namespace {

using io::Cloud;
using io::ScalarType;
using io::valueOf;

/** \brief One field of a cloud that is made. */
struct Column {
  std::string name;
  ScalarType type;
  std::vector<double> values;
};

Cloud
cloudOf(const std::vector<Column>& columns)
{
  Cloud cloud;
  for (const Column& column : columns)
    cloud.addField(column.name, column.type);
  cloud.width = columns[0].values.size();
  cloud.data.resize(cloud.width * cloud.point_size);
  for (std::size_t c = 0; c < columns.size(); ++c)
    for (std::size_t i = 0; i < cloud.width; ++i)
      storeValue(cloud.point(i), cloud.fields[c], columns[c].values[i]);
  return cloud;
}

/** \brief Points on a line along x. */
std::vector<Column>
alongX(const std::vector<double>& x, ScalarType type = ScalarType::Float32)
{
  const std::vector<double> middle(x.size(), 0.5);
  return {{"x", type, x}, {"y", type, middle}, {"z", type, middle}};
}

RigidTransform
moved(double x, double y, double z)
{
  RigidTransform pose;
  pose.translation = {x, y, z};
  return pose;
}

class MergedCloud : public FolderTest {
protected:
  void
  addScan(const Cloud& cloud, const RigidTransform& pose = {})
  {
    scans_.push_back({path("scan" + std::to_string(scans_.size()) + ".pcd"), pose});
    io::writeCloud(scans_.back().path, cloud);
  }

  Cloud
  merge(double leaf, const std::string& name = "map.pcd")
  {
    const std::size_t count = writeMergedCloud(scans_, leaf, path(name));
    Cloud cloud = io::readCloud(path(name));
    EXPECT_EQ(cloud.size(), count);
    return cloud;
  }

  std::vector<MapInput> scans_;
};

TEST_F(MergedCloud, keepsThePointNearestToTheMiddleOfItsVoxel)
{
  addScan(cloudOf(alongX({0.1, 0.7, 1.2, -0.9})));
  addScan(cloudOf(alongX({0.45, 0.6, -1.55, 3.1})), moved(0, 0, 0));
  const Cloud map = merge(1);
  ASSERT_EQ(map.size(), 5u);
  // In the order in which voxels are met.
  const double expected[] = {0.45, 1.2, -0.9, -1.55, 3.1};
  for (std::size_t i = 0; i < map.size(); ++i)
    EXPECT_FLOAT_EQ(valueOf(map, i, "x"), expected[i]);
}

TEST_F(MergedCloud, firstOfEquallyNearPointsIsKept)
{
  addScan(cloudOf(alongX({0.25})));
  addScan(cloudOf(alongX({0.75})));
  EXPECT_EQ(valueOf(merge(1), 0, "x"), 0.25);
}

TEST_F(MergedCloud, zeroOfEitherSignIsOneVoxel)
{
  addScan(cloudOf(alongX({-0.0, 0.0})));
  EXPECT_EQ(merge(1).size(), 1u);
}

TEST_F(MergedCloud, movesPointsAndTurnsNormals)
{
  std::vector<Column> columns = alongX({1});
  for (const char* name : {"normal_x", "normal_y", "normal_z"})
    columns.push_back({name, ScalarType::Float32, {name[7] == 'x' ? 1.0 : 0.0}});
  RigidTransform pose = moved(10, 20, 30);
  pose.rotation << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  addScan(cloudOf(columns), pose);
  const Cloud map = merge(0.1);
  EXPECT_FLOAT_EQ(valueOf(map, 0, "x"), 9.5);
  EXPECT_FLOAT_EQ(valueOf(map, 0, "y"), 21);
  EXPECT_FLOAT_EQ(valueOf(map, 0, "z"), 30.5);
  EXPECT_FLOAT_EQ(valueOf(map, 0, "normal_x"), 0);
  EXPECT_FLOAT_EQ(valueOf(map, 0, "normal_y"), 1);
}

TEST_F(MergedCloud, viewpointsOfScansAreNotTheMaps)
{
  Cloud cloud = cloudOf(alongX({1}));
  cloud.viewpoint = {1, 2, 3, 1, 0, 0, 0};
  addScan(cloud, moved(1, 1, 1));
  EXPECT_EQ(merge(1).viewpoint, Cloud().viewpoint);
}

TEST_F(MergedCloud, keepsFieldsThatAllScansHave)
{
  std::vector<Column> first = alongX({0.2, 1.5}), second = alongX({0.5, 2.5});
  first.push_back({"ring", ScalarType::Uint16, {1, 2}});
  first.push_back({"intensity", ScalarType::Float32, {10, 11}});
  second.push_back({"intensity", ScalarType::Float32, {20, 21}});
  addScan(cloudOf(first));
  addScan(cloudOf(second));
  const Cloud map = merge(1);
  EXPECT_EQ(map.find("ring"), nullptr);
  ASSERT_EQ(map.size(), 3u);
  EXPECT_EQ(valueOf(map, 0, "intensity"), 20) << "of the point that is kept";
  EXPECT_EQ(valueOf(map, 1, "intensity"), 11);
  EXPECT_EQ(valueOf(map, 2, "intensity"), 21);
}

TEST_F(MergedCloud, fieldsOfDifferentTypesKeepTheirValues)
{
  std::vector<Column> first = alongX({0.5}), second = alongX({1.5});
  first.push_back({"intensity", ScalarType::Uint8, {200}});
  second.push_back({"intensity", ScalarType::Float32, {0.25}});
  addScan(cloudOf(first));
  addScan(cloudOf(second));
  const Cloud map = merge(1);
  EXPECT_EQ(valueOf(map, 0, "intensity"), 200);
  EXPECT_EQ(valueOf(map, 1, "intensity"), 0.25);
}

TEST_F(MergedCloud, colorsOfEitherTypeKeepTheirBytes)
{
  const std::uint32_t orange = 0x00f08214;
  float packed;
  std::memcpy(&packed, &orange, 4);
  std::vector<Column> first = alongX({0.5}), second = alongX({1.5});
  first.push_back({"rgb", ScalarType::Float32, {packed}});
  second.push_back({"rgb", ScalarType::Uint32, {double(orange)}});
  addScan(cloudOf(first));
  addScan(cloudOf(second));
  const Cloud map = merge(1);
  ASSERT_EQ(map.find("rgb")->byteSize(), 4u);
  for (std::size_t i = 0; i < 2; ++i) {
    std::uint32_t color;
    std::memcpy(&color, map.point(i) + map.find("rgb")->offset, 4);
    EXPECT_EQ(color, orange);
  }
  const Cloud ply = merge(1, "map.ply");
  std::uint32_t color;
  std::memcpy(&color, ply.point(0) + ply.find("rgb")->offset, 4);
  EXPECT_EQ(color, orange);
}

TEST_F(MergedCloud, coordinatesAreDoublesWhereTheyNeedToBe)
{
  addScan(cloudOf(alongX({0.5, 1.5})));
  EXPECT_EQ(merge(1).find("x")->type, ScalarType::Float32);

  addScan(cloudOf(alongX({2.5 + 1e-9}, ScalarType::Float64)));
  const Cloud with_double = merge(1);
  EXPECT_EQ(with_double.find("x")->type, ScalarType::Float64);
  EXPECT_EQ(valueOf(with_double, 2, "x"), 2.5 + 1e-9);

  scans_.clear();
  addScan(cloudOf(alongX({0.125, 1.5})), moved(3e6, 5e6, 0));
  const Cloud far = merge(1);
  EXPECT_EQ(far.find("x")->type, ScalarType::Float64);
  EXPECT_EQ(valueOf(far, 0, "x"), 3e6 + 0.125);
}

TEST_F(MergedCloud, pointsThatAreNotFiniteAreSkipped)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  addScan(cloudOf(alongX({nan, 0.5, infinity, 1e30})));
  EXPECT_EQ(merge(1).size(), 2u);
}

TEST_F(MergedCloud, manyPointsAreOneAVoxelWhateverTheTableHolds)
{
  made::Random random(3);
  std::vector<double> x, y, z;
  std::set<std::array<double, 3>> voxels;
  for (int i = 0; i < 20000; ++i) {
    std::array<double, 3> voxel, point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      voxel[axis] = std::floor(random.uniform(-8, 8));
      // Away from the faces, which single precision may cross.
      point[axis] = voxel[axis] + random.uniform(0.1, 0.9);
    }
    voxels.insert(voxel);
    x.push_back(point[0]);
    y.push_back(point[1]);
    z.push_back(point[2]);
  }
  ASSERT_GT(voxels.size(), 3000u);
  const Cloud cloud = cloudOf({{"x", ScalarType::Float32, x},
                               {"y", ScalarType::Float32, y},
                               {"z", ScalarType::Float32, z}});
  addScan(cloud);
  addScan(cloud);
  EXPECT_EQ(merge(1).size(), voxels.size());
  const std::string bytes = io::readFile(path("map.pcd"));
  merge(1);
  EXPECT_EQ(io::readFile(path("map.pcd")), bytes);
}

TEST_F(MergedCloud, errorsNameTheFileAndLeaveTheOutputAlone)
{
  addScan(cloudOf(alongX({0.5})));
  merge(1);
  const std::string before = io::readFile(path("map.pcd"));
  EXPECT_THROW(writeMergedCloud(scans_, 0, path("map.pcd")), std::invalid_argument);
  scans_.push_back({path("missing.pcd"), {}});
  const std::string complaint = io::complaintOf(
      [&](const std::string& output) { writeMergedCloud(scans_, 1, output); },
      path("map.pcd"));
  EXPECT_TRUE(io::contains(complaint, "missing.pcd")) << complaint;
  EXPECT_EQ(io::readFile(path("map.pcd")), before);
  scans_.clear();
  EXPECT_THROW(writeMergedCloud(scans_, 1, path("map.pcd")), io::InputError);
}

} // namespace
} // namespace pcl_flashreg::map
