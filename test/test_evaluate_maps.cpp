// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What an evaluation of whole scenes goes by.

#include "evaluate/datasets/cloud_sets.h"
#include "evaluate/datasets/known_poses.h"
#include "evaluate/results/map_summary.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <limits>

namespace pcl_flashreg::evaluate {
namespace {

Pair
pairOf(const std::string& dataset,
       const std::string& scene,
       const std::string& source,
       const std::string& target)
{
  Pair pair;
  pair.dataset = dataset;
  pair.scene = scene;
  pair.source = source;
  pair.target = target;
  return pair;
}

std::vector<const Pair*>
pointersTo(const std::vector<Pair>& pairs)
{
  std::vector<const Pair*> pointers;
  for (const Pair& pair : pairs)
    pointers.push_back(&pair);
  return pointers;
}

using Clouds = std::vector<std::string>;

TEST(CloudSets, areThoseOfScenes)
{
  const std::vector<Pair> pairs = {pairOf("d", "kitchen", "k/1", "k/0"),
                                   pairOf("d", "den", "d/1", "d/0"),
                                   pairOf("d", "kitchen", "k/3", "k/2")};
  const std::vector<CloudSet> sets = cloudSets(pointersTo(pairs));
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[0].name, "kitchen");
  EXPECT_EQ(sets[0].clouds, (Clouds{"k/0", "k/1", "k/2", "k/3"}))
      << "of one scene, though no pair ties them";
  EXPECT_EQ(sets[1].name, "den");
  EXPECT_EQ(sets[1].clouds, (Clouds{"d/0", "d/1"}));
}

TEST(CloudSets, ofTwoDataSetsAreOneWhereTheyShareClouds)
{
  const std::vector<Pair> pairs = {pairOf("near", "kitchen", "k/1", "k/0"),
                                   pairOf("near", "", "x", "y"),
                                   pairOf("far", "kitchen", "k/2", "k/1"),
                                   pairOf("other", "kitchen", "o/1", "o/0"),
                                   pairOf("late", "all", "o/0", "k/0")};
  const std::vector<CloudSet> sets = cloudSets(pointersTo(pairs));
  ASSERT_EQ(sets.size(), 2u);
  EXPECT_EQ(sets[0].name, "kitchen, all");
  EXPECT_EQ(sets[0].clouds, (Clouds{"k/0", "k/1", "k/2", "o/0", "o/1"}));
  EXPECT_EQ(sets[1].name, "near") << "without a scene, the data set";
}

TEST(KnownPoses, areChained)
{
  // T_target_source of 1 to 0, of 2 to 1; 3 overlaps nothing.
  std::vector<Pair> pairs = {pairOf("d", "s", "1", "0"),
                             pairOf("d", "s", "2", "1"),
                             pairOf("d", "s", "3", "0")};
  Eigen::Isometry3d a = Eigen::Isometry3d::Identity(), b = a;
  a.rotate(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()));
  a.pretranslate(Eigen::Vector3d(1, -2, 0.5));
  b.rotate(Eigen::AngleAxisd(-1.2, Eigen::Vector3d(3, 0, 1).normalized()));
  b.pretranslate(Eigen::Vector3d(0, 4, 1));
  pairs[0].T_target_source = {a.rotation(), a.translation()};
  pairs[1].T_target_source = {b.rotation(), b.translation()};
  pairs[2].T_target_source.translation.setConstant(
      std::numeric_limits<double>::quiet_NaN());
  const KnownPoses poses(pointersTo(pairs));
  const auto expectPose = [&](const char* target,
                              const char* source,
                              const Eigen::Isometry3d& truth) {
    const auto pose = poses.between(target, source);
    ASSERT_TRUE(pose) << target << ' ' << source;
    EXPECT_TRUE(pose->toIsometry().isApprox(truth, 1e-12)) << target << ' ' << source;
  };
  expectPose("0", "1", a);
  expectPose("1", "0", a.inverse());
  expectPose("0", "2", a * b);
  expectPose("2", "0", (a * b).inverse());
  expectPose("1", "1", Eigen::Isometry3d::Identity());
  EXPECT_FALSE(poses.between("0", "3"));
  EXPECT_FALSE(poses.between("0", "elsewhere"));
}

TEST(KnownPoses, takeAPairsOwnPoseWhereThereIsOne)
{
  std::vector<Pair> pairs = {pairOf("d", "s", "1", "0"),
                             pairOf("d", "s", "2", "1"),
                             pairOf("d", "s", "2", "0")};
  pairs[2].T_target_source.translation = {0, 0, 0.1};
  EXPECT_EQ(KnownPoses(pointersTo(pairs)).between("0", "2")->translation.z(), 0.1);
}

TEST(MapSummaries, areATable)
{
  EXPECT_EQ(formatMaps({}), "");
  MapSummary map;
  map.name = "kitchen";
  map.scans = 60;
  map.placed = 58;
  map.wrong_edges = 3;
  map.seconds = 12.34;
  const std::string table = formatMaps({map});
  for (const char* text : {"  kitchen ", " 60 ", " 58 ", " 3 ", " 12.3\n"})
    EXPECT_NE(table.find(text), std::string::npos) << text << "in\n" << table;
}

} // namespace
} // namespace pcl_flashreg::evaluate
