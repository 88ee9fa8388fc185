// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "io/file.h"
#include "map/density.h"
#include "map/map_picture.h"
#include "map/map_view.h"
#include "map/scan_colors.h"
#include "map/short_names.h"
#include "support/made_hall_scans.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <numeric>
#include <set>

namespace fs = std::filesystem;

namespace pcl_flashreg::map {
namespace {

using drawing::Color;

/** \brief Scans of the hall that lie where they belong. */
class MapPicture : public ::testing::Test {
protected:
  explicit MapPicture(bool level = true) : hall_(level)
  {
    PairRegistration registration(BackendKind::Cpu, 1);
    for (const auto& points : hall_.scans) {
      ScanInput<double> input;
      input.points = {points[0].data(), points.size(), 3, nullptr, 0};
      input.viewpoint_known = true;
      scans_.push_back(registration.makeScan(
          input, made::HallScans::RESOLUTION, ScanContent::Surface));
    }
    result_.scans.resize(scans_.size());
    result_.groups.resize(1);
    for (std::size_t i = 0; i < scans_.size(); ++i) {
      result_.groups[0].push_back(i);
      result_.scans[i].T_group_scan = hall_.pose(0, i);
      names_.push_back("hall/" + std::to_string(i) + ".pcd");
    }
    tie(0, 1);
    tie(1, 2);
  }

  void
  tie(std::size_t target, std::size_t source)
  {
    MapEdge edge;
    edge.target = target;
    edge.source = source;
    edge.fate = EdgeFate::Used;
    result_.edges.push_back(edge);
  }

  /** \brief Makes a group of its own of the scans from `first` on. */
  void
  split(std::size_t first)
  {
    std::vector<std::size_t>& all = result_.groups[0];
    const std::vector<std::size_t> rest(all.begin() + std::ptrdiff_t(first), all.end());
    all.resize(first);
    result_.groups.push_back(rest);
    for (const std::size_t i : rest) {
      result_.scans[i].group = result_.groups.size() - 1;
      result_.scans[i].T_group_scan = hall_.pose(first, i);
    }
  }

  MultiviewRegistration::ScanSource
  source() const
  {
    return [this](std::size_t i) { return scans_[i]; };
  }

  FlatGroup
  flat(std::size_t most = 4000000) const
  {
    return seenFromAbove(result_.groups[0], result_, source(), most);
  }

  std::string
  png(const std::string& name) const
  {
    const fs::path path = fs::temp_directory_path() / ("pcl_flashreg_" + name + ".png");
    writeMapPicture(path.string(), names_, result_, source());
    const std::string bytes = io::readFile(path.string());
    fs::remove(path);
    return bytes;
  }

  made::HallScans hall_;
  std::vector<Scan> scans_;
  std::vector<std::string> names_;
  MultiviewResult result_;
};

/** \brief Scans that were turned anyhow. */
class TurnedMapPicture : public MapPicture {
protected:
  TurnedMapPicture() : MapPicture(false) {}
};

void
expectHallFromAbove(const FlatGroup& group, const made::HallScans& hall)
{
  // 8 m x 6 m; a tilt of two degrees would add 0.1 m.
  EXPECT_NEAR(group.box.sizes().x(), 8, 0.1);
  EXPECT_NEAR(group.box.sizes().y(), 6, 0.1);
  for (std::size_t a = 0; a < hall.scans.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const Eigen::Vector3d between =
          hall.T_hall_scan[a].translation() - hall.T_hall_scan[b].translation();
      EXPECT_NEAR((group.scans[a].place - group.scans[b].place).norm(),
                  between.head<2>().norm(),
                  0.02);
    }
}

/** \brief Whether three places have the sense of rotation that they have from above. */
bool
isFromAbove(const FlatGroup& group, const made::HallScans& hall)
{
  const auto turn = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  };
  const auto& flat = group.scans;
  const auto place = [&](std::size_t i) -> Eigen::Vector2d {
    return hall.T_hall_scan[i].translation().head<2>();
  };
  return turn(flat[3].place - flat[0].place, flat[5].place - flat[0].place) *
             turn(place(3) - place(0), place(5) - place(0)) >
         0;
}

TEST_F(MapPicture, levelScansAreSeenFromAbove)
{
  const FlatGroup group = flat();
  expectHallFromAbove(group, hall_);
  EXPECT_TRUE(isFromAbove(group, hall_));
  EXPECT_EQ(group.spacing, made::HallScans::RESOLUTION);
  EXPECT_EQ(group.weight, 1);
}

TEST_F(TurnedMapPicture, thinnestDirectionIsUpWhereScansAreTurnedAnyhow)
{
  expectHallFromAbove(flat(), hall_);
}

TEST_F(MapPicture, fewerPointsCountForMore)
{
  const FlatGroup all = flat(), few = flat(1000);
  const auto points = [](const FlatGroup& group) {
    return std::accumulate(group.scans.begin(),
                           group.scans.end(),
                           0.0,
                           [](double sum, const FlatScan& scan) {
                             return sum + double(scan.points.cols());
                           });
  };
  EXPECT_LE(points(few), 1000);
  EXPECT_NEAR(few.weight * points(few), points(all), 1e-6 * points(all));
}

TEST_F(MapPicture, placesFarOutsideAreNotDrawn)
{
  result_.groups[0] = {0, 1};
  const Eigen::Vector2d before = flat().scans[0].place;
  EXPECT_TRUE(flat().box.contains(before));
  PairRegistration registration(BackendKind::Cpu, 1);
  // One wall of the hall, seen from afar.
  std::vector<Eigen::Vector3d> wall;
  for (const auto& point : hall_.scans[0])
    if (point.x() > 2)
      wall.push_back(point);
  ScanInput<double> input;
  input.points = {wall[0].data(), wall.size(), 3, nullptr, 0};
  input.viewpoint = {-40, 0, 0};
  input.viewpoint_known = true;
  scans_[0] = registration.makeScan(input, 0.1, ScanContent::Surface);
  ASSERT_TRUE(scans_[0].viewpoint());
  EXPECT_LT(flat().box.sizes().maxCoeff(), 12);
}

TEST(Upwards, saysNothingThatIsNotKnown)
{
  // Neither normals nor turns: z, as long as the points are flat along it, or nearly.
  Eigen::Matrix3Xf points(3, 4);
  points << 1, -1, 0, 0, 0, 0, 1, -1, 0.1f, 0.1f, -0.1f, -0.1f;
  const std::vector<Eigen::Matrix3d> axes(2, Eigen::Matrix3d::Identity());
  const Eigen::Matrix3Xf none(3, 0);
  EXPECT_TRUE(upwards(axes, points, none).isApprox(Eigen::Vector3d::UnitZ(), 1e-6));
  // Cameras have y downwards.
  const Eigen::Matrix3Xf upright = Eigen::Vector3f(1, -1, 1).asDiagonal() *
                                   Eigen::Matrix3Xf(points({0, 2, 1}, Eigen::all));
  EXPECT_TRUE(upwards(axes, upright, none).isApprox(-Eigen::Vector3d::UnitY(), 1e-6));
}

TEST(Upwards, turnsToTheNormalsOfFloorsAndWalls)
{
  const Eigen::AngleAxisd tilt(0.12, Eigen::Vector3d::UnitX());
  made::Random random(3);
  Eigen::Matrix3Xf points(3, 900), normals(3, 900);
  for (int i = 0; i < 900; ++i) {
    points.col(i) =
        random.inCube(1).cwiseProduct(Eigen::Vector3d(5, 5, 1)).cast<float>();
    // A third each of floor, walls and what is neither.
    const double angle = random.uniform(0, 6.28);
    const Eigen::Vector3d n = i % 3 == 0   ? Eigen::Vector3d::UnitZ()
                              : i % 3 == 1 ? Eigen::Vector3d(cos(angle), sin(angle), 0)
                                           : random.inCube(1).normalized();
    normals.col(i) = (tilt * n).cast<float>();
  }
  const std::vector<Eigen::Matrix3d> axes(1, Eigen::Matrix3d::Identity());
  const Eigen::Vector3d up = upwards(axes, points, normals);
  EXPECT_GT(up.dot(tilt * Eigen::Vector3d::UnitZ()), std::cos(0.01));
}

TEST_F(MapPicture, tiedScansHaveDifferentColors)
{
  const auto differ = [](Color a, Color b) {
    return a.red != b.red || a.green != b.green || a.blue != b.blue;
  };
  for (std::size_t i = 0; i < scans_.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      tie(k, i);
  const std::vector<Color> colors = scanColors(result_);
  for (std::size_t i = 0; i < colors.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_TRUE(differ(colors[i], colors[k])) << i << ' ' << k;
}

TEST(Density, isStrongestWhereMostPointsAre)
{
  FlatGroup group;
  group.spacing = 1;
  group.scans.resize(2);
  group.scans[0].points.resize(2, 500);
  for (int i = 0; i < 500; ++i)
    group.scans[0].points.col(i) << float(i % 10) - 5, 0;
  group.scans[1].scan = 1;
  group.scans[1].points.resize(2, 101);
  for (int i = 0; i < 100; ++i)
    group.scans[1].points.col(i) << float(i % 10) - 5, float(i / 10) + 3;
  group.scans[1].points.col(100).setZero();
  const Scale scale{1, {0, 0}, 41, 41};
  const drawing::Canvas canvas =
      densityOf(group, scale, {{255, 0, 0}, {0, 0, 255}}, {255, 255, 255});
  const auto at = [&](double x, double y) {
    const Eigen::Vector2d pixel = scale.pixelOf({x, y});
    return canvas.pixels()[int(pixel.y()) * 41 + int(pixel.x())];
  };
  EXPECT_EQ(at(0, 0).red, 255) << "the scan with most points there";
  EXPECT_LT(at(0, 0).blue, 60);
  EXPECT_EQ(at(0, 6).blue, 255);
  EXPECT_GT(at(0, 6).red, at(0, 0).blue) << "fewer points, and weaker";
  EXPECT_LT(at(0, 6).red, 250);
  EXPECT_EQ(at(-15, -15).red, 255) << "paper";
  EXPECT_EQ(at(-15, -15).blue, 255);
}

TEST(ShortNames, leaveOutWhatIsTheSame)
{
  using Names = std::vector<std::string>;
  EXPECT_EQ(shortNames({"a/cloud_10.pcd", "a/cloud_12.pcd", "a/cloud_2.pcd"}),
            (Names{"10", "12", "2"}));
  EXPECT_EQ(shortNames({"scan1_0.ply", "scan1_00.ply"}), (Names{"0", "00"}));
  EXPECT_EQ(shortNames({"top.ply", "ear.ply"}), (Names{"top", "ear"}));
  EXPECT_EQ(shortNames({"a.ply", "a.ply"}), (Names{"a.ply", "a.ply"}));
  EXPECT_EQ(shortNames({"room.ply", "room.ply.ply"}),
            (Names{"room.ply", "room.ply.ply"}));
  EXPECT_EQ(shortNames({"one.ply"}), (Names{"one.ply"}));
}

TEST_F(MapPicture, isAPng)
{
  if (!kMapPictureBuiltIn)
    GTEST_SKIP() << "built without pictures";
  const std::string whole = png("whole");
  EXPECT_EQ(whole.substr(1, 3), "PNG");
  EXPECT_EQ(png("again"), whole);
  split(4);
  const std::string groups = png("groups");
  EXPECT_EQ(groups.substr(1, 3), "PNG");
  EXPECT_NE(groups, whole);
}

TEST_F(MapPicture, ofNoGroupSaysSo)
{
  if (!kMapPictureBuiltIn)
    GTEST_SKIP() << "built without pictures";
  for (std::size_t i = scans_.size(); i-- > 1;)
    split(i);
  result_.edges.clear();
  EXPECT_EQ(png("nothing").substr(1, 3), "PNG");
}

} // namespace
} // namespace pcl_flashreg::map
