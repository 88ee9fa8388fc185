// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan_pair.h"

#include <pcl/io/pcd_io.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace generator = pcl_flashreg::generator;
using generator::bundled_seed;
using generator::makeScanPair;
using generator::Points;
using generator::ScanPair;

namespace {

struct Kind {
  std::string scene;
  /** \brief Points this near are the same surface: noise and sampling. Metres. */
  float near;
  /** \brief Shares of the source points that are near a target point, at least under
   * the true pose and at most under its inverse. */
  double true_share;
  double false_share;
};

void
PrintTo(const Kind& kind, std::ostream* stream)
{
  *stream << kind.scene;
}

/** \brief The pairs that come with the project, made once. */
const ScanPair&
bundledPair(const std::string& scene)
{
  static const ScanPair indoor = makeScanPair("indoor", bundled_seed);
  static const ScanPair street = makeScanPair("street", bundled_seed);
  return scene == "indoor" ? indoor : street;
}

pcl::PointCloud<pcl::PointXYZ>::Ptr
toCloud(const Points& points)
{
  auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const auto& point : points)
    cloud->emplace_back(point.x(), point.y(), point.z());
  return cloud;
}

Points
toPoints(const pcl::PointCloud<pcl::PointXYZ>& cloud)
{
  Points points;
  for (const auto& point : cloud)
    points.emplace_back(point.getVector3fMap());
  return points;
}

/** \brief Share of the points, moved by the pose, with a reference point within reach.
 */
double
nearShare(const Points& points,
          const Eigen::Isometry3d& pose,
          const Points& reference,
          float reach)
{
  pcl::KdTreeFLANN<pcl::PointXYZ> tree;
  tree.setInputCloud(toCloud(reference));
  std::vector<int> index(1);
  std::vector<float> squared_distance(1);
  std::size_t near = 0;
  for (const auto& point : points) {
    const Eigen::Vector3f moved = (pose * point.cast<double>()).cast<float>();
    tree.nearestKSearch(
        pcl::PointXYZ(moved.x(), moved.y(), moved.z()), 1, index, squared_distance);
    near += squared_distance[0] < reach * reach ? 1 : 0;
  }
  return static_cast<double>(near) / static_cast<double>(points.size());
}

Points
readBundled(const std::string& scene, const std::string& file)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  const std::string path =
      std::string(PCL_FLASHREG_SOURCE_DIR) + "/data/" + scene + "/" + file + ".pcd";
  EXPECT_EQ(pcl::io::loadPCDFile(path, cloud), 0) << path;
  return toPoints(cloud);
}

/** \brief A processor or library that rounds differently may move a ray across an edge:
 * a few points may differ, no more. */
void
expectSamePoints(const Points& a, const Points& b)
{
  ASSERT_FALSE(a.empty());
  ASSERT_FALSE(b.empty());
  EXPECT_GT(nearShare(a, Eigen::Isometry3d::Identity(), b, 1e-4f), 0.999);
  EXPECT_GT(nearShare(b, Eigen::Isometry3d::Identity(), a, 1e-4f), 0.999);
}

class Generator : public testing::TestWithParam<Kind> {};

} // namespace

TEST_P(Generator, sameSeedGivesIdenticalPoints)
{
  const auto& first = bundledPair(GetParam().scene);
  const auto second = makeScanPair(GetParam().scene, bundled_seed);
  EXPECT_EQ(first.source, second.source);
  EXPECT_EQ(first.target, second.target);
  EXPECT_EQ(first.T_target_source.matrix(), second.T_target_source.matrix());
}

TEST_P(Generator, otherSeedGivesAnotherPair)
{
  const auto& first = bundledPair(GetParam().scene);
  const auto second = makeScanPair(GetParam().scene, bundled_seed + 1);
  EXPECT_NE(first.source, second.source);
  EXPECT_FALSE(first.T_target_source.isApprox(second.T_target_source, 1e-3));
}

TEST_P(Generator, truePoseAlignsAndItsInverseDoesNot)
{
  const auto& kind = GetParam();
  const auto& pair = bundledPair(kind.scene);
  EXPECT_GT(nearShare(pair.source, pair.T_target_source, pair.target, kind.near),
            kind.true_share);
  EXPECT_LT(
      nearShare(pair.source, pair.T_target_source.inverse(), pair.target, kind.near),
      kind.false_share);
}

TEST_P(Generator, pointsAreFiniteAndWithinTheSensorsRange)
{
  const float range = GetParam().scene == "indoor" ? 5.5f : 80.2f;
  const auto& pair = bundledPair(GetParam().scene);
  for (const auto* points : {&pair.source, &pair.target}) {
    EXPECT_GT(points->size(), 30000u);
    EXPECT_LT(points->size(), 60000u);
    for (const auto& point : *points)
      ASSERT_LT(point.norm(), range);
  }
}

TEST_P(Generator, bundledPairIsWhatItMakes)
{
  const auto& scene = GetParam().scene;
  const auto& pair = bundledPair(scene);
  expectSamePoints(pair.source, readBundled(scene, "source"));
  expectSamePoints(pair.target, readBundled(scene, "target"));

  std::ifstream stream(std::string(PCL_FLASHREG_SOURCE_DIR) + "/data/" + scene +
                       "/T_target_source.txt");
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      double value = NAN;
      stream >> value;
      EXPECT_NEAR(value, pair.T_target_source(row, column), 1e-9);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes,
                         Generator,
                         testing::Values(Kind{"indoor", 0.04f, 0.5, 0.1},
                                         Kind{"street", 0.3f, 0.55, 0.3}),
                         [](const auto& kind) { return kind.param.scene; });

TEST(GeneratorScenes, unknownNameIsAnError)
{
  EXPECT_THROW(makeScanPair("moon", bundled_seed), std::invalid_argument);
}
