// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The parts of src/multiview, each by itself.

#include "multiview/likeness.h"
#include "multiview/map_scans.h"
#include "multiview/pose_graph.h"
#include "multiview/votes.h"
#include "support/made_correspondences.h"
#include "support/made_scans.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace pcl_flashreg {
namespace {

Eigen::Isometry3d
poseOf(double angle, const Eigen::Vector3d& axis, const Eigen::Vector3d& place)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(angle, axis.normalized()));
  pose.pretranslate(place);
  return pose;
}

/** \brief Twelve nodes on a circle, which look ahead. */
std::vector<Eigen::Isometry3d>
ring()
{
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < 12; ++i) {
    const double turn = i * 2 * M_PI / 12;
    poses.push_back(
        poseOf(turn, {0.1, 0.2, 1}, {5 * std::cos(turn), 5 * std::sin(turn), 0.1 * i}));
  }
  return poses;
}

PoseConstraint
constraintOf(const std::vector<Eigen::Isometry3d>& poses,
             std::size_t target,
             std::size_t source)
{
  PoseConstraint constraint;
  constraint.target = target;
  constraint.source = source;
  constraint.T_target_source = poses[target].inverse() * poses[source];
  constraint.middle = {0.5, -0.3, 0.2};
  constraint.hessian.diagonal() << 400, 300, 500, 100, 200, 150;
  return constraint;
}

std::vector<PoseConstraint>
ringConstraints(const std::vector<Eigen::Isometry3d>& poses)
{
  std::vector<PoseConstraint> constraints;
  for (std::size_t i = 0; i < poses.size(); ++i)
    for (const std::size_t ahead : {1, 2})
      constraints.push_back(constraintOf(poses, i, (i + ahead) % poses.size()));
  return constraints;
}

std::vector<Eigen::Isometry3d>
disturbed(std::vector<Eigen::Isometry3d> poses, double angle, double way)
{
  made::Random random(3);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    poses[i].rotate(Eigen::AngleAxisd(angle, random.inCube(1).normalized()));
    poses[i].pretranslate(way * random.inCube(1));
  }
  return poses;
}

double
largestError(const std::vector<Eigen::Isometry3d>& a,
             const std::vector<Eigen::Isometry3d>& b)
{
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    largest = std::max(largest, (a[i].matrix() - b[i].matrix()).norm());
  return largest;
}

TEST(PoseGraph, FindsPosesThatFit)
{
  const auto truth = ring();
  auto poses = disturbed(truth, 0.1, 0.2);
  optimize(ringConstraints(truth), poses);
  EXPECT_LT(largestError(poses, truth), 1e-5);
}

TEST(PoseGraph, KeepsTheFirst)
{
  const auto truth = ring();
  auto poses = disturbed(truth, 0.1, 0.2);
  const Eigen::Isometry3d first = poses.front();
  optimize(ringConstraints(truth), poses);
  EXPECT_EQ(poses.front().matrix(), first.matrix());
}

TEST(PoseGraph, AConstraintThatDoesNotFitLosesItsSay)
{
  const auto truth = ring();
  auto constraints = ringConstraints(truth);
  constraints.push_back(constraintOf(truth, 0, 6));
  constraints.back().T_target_source.pretranslate(Eigen::Vector3d(2, 1, 0));
  auto poses = disturbed(truth, 0.02, 0.05);
  optimize(constraints, poses);
  // Squared residuals would move the ring by a quarter of a metre.
  EXPECT_LT(largestError(poses, truth), 0.03);
}

TEST(PoseGraph, ResidualIsTurnAndShiftAboutTheMiddle)
{
  const auto truth = ring();
  const PoseConstraint constraint = constraintOf(truth, 2, 3);
  EXPECT_LT(residualOf(constraint, truth[2], truth[3]).norm(), 1e-12);
  // The source, turned about the middle of the constraint: nothing but a turn.
  const Eigen::Vector3d axis(0, 0, 1), at = constraint.middle;
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translate(at);
  turn.rotate(Eigen::AngleAxisd(0.03, axis));
  turn.translate(-at);
  const auto residual =
      residualOf(constraint, truth[2], truth[2] * turn * constraint.T_target_source);
  EXPECT_LT((residual.head<3>() - 0.03 * axis).norm(), 1e-9);
  EXPECT_LT(residual.tail<3>().norm(), 1e-9);
}

TEST(PoseGraph, NodesThatNothingTiesStay)
{
  std::vector<Eigen::Isometry3d> one{Eigen::Isometry3d::Identity()};
  optimize({}, one);
  EXPECT_TRUE(one.front().isApprox(Eigen::Isometry3d::Identity()));
}

/** \brief Scans without points: votes need their frames and their spacing alone. */
class Votes : public ::testing::Test {
protected:
  Votes() : poses(4, Eigen::Isometry3d::Identity())
  {
    poses[1].translation() << 1, 0, 0;
    poses[2].translation() << 0, 2, 0;
  }

  /** \brief That scan 3 is at a place, in the frame of scans 0 to 2. */
  PairVotes
  says(std::size_t fixed, double probability, const Eigen::Vector3d& place) const
  {
    Eigen::Isometry3d at = Eigen::Isometry3d::Identity();
    at.translation() = place;
    return {fixed, 3, {{probability, poses[fixed].inverse() * at}}};
  }

  Placements
  count(const std::vector<PairVotes>& pairs) const
  {
    std::vector<const PairVotes*> pointers;
    for (const PairVotes& pair : pairs)
      pointers.push_back(&pair);
    return countVotes(pointers, {false, false, false, true}, poses, 0.05, 5);
  }

  MapPoses poses;
};

TEST_F(Votes, ThreeThatAgreeBeatOneThatIsSurer)
{
  const Eigen::Vector3d right(3, 3, 0), wrong(-2, 1, 0);
  const Placements placements = count({says(0, 0.3, right + Eigen::Vector3d(0.1, 0, 0)),
                                       says(1, 0.4, right),
                                       says(2, 0.3, right),
                                       says(0, 0.6, wrong)});
  ASSERT_GE(placements.best.size(), 2u);
  EXPECT_LT((placements.best[0].T_fixed_moving.translation() - right).norm(), 0.1);
  EXPECT_EQ(placements.best[0].supporters, 3u);
  EXPECT_GT(placements.best[0].votes, placements.best[1].votes);
  EXPECT_GT(placements.best[0].votes, placements.none);
}

TEST_F(Votes, OnePairHasTheOddsItHasByItself)
{
  const Placements placements = count({says(0, 0.8, {1, 1, 1})});
  ASSERT_EQ(placements.best.size(), 1u);
  EXPECT_NEAR(placements.best[0].votes - placements.none, std::log(0.8 / 0.2), 0.01);
}

TEST_F(Votes, ASurePairElsewhereSpeaksAgainst)
{
  const double alone = count({says(0, 0.5, {1, 1, 1})}).best[0].votes;
  const Placements placements =
      count({says(0, 0.5, {1, 1, 1}), says(1, 0.9, {4, 1, 1})});
  for (const Placement& placement : placements.best)
    if (placement.T_fixed_moving.translation().x() < 2) {
      EXPECT_NEAR(placement.votes, alone + std::log(0.1), 0.1);
    }
}

TEST_F(Votes, AreTheSameWhicheverScanIsTheTarget)
{
  PairVotes turned = says(0, 0.7, {1, 2, 3});
  std::swap(turned.target, turned.source);
  turned.votes[0].T_target_source = turned.votes[0].T_target_source.inverse();
  const Placements a = count({says(0, 0.7, {1, 2, 3})}), b = count({turned});
  EXPECT_LT(
      (a.best[0].T_fixed_moving.matrix() - b.best[0].T_fixed_moving.matrix()).norm(),
      1e-12);
  EXPECT_EQ(a.best[0].votes, b.best[0].votes);
}

class WaysOfAPair : public ::testing::Test {
protected:
  static ScanRelation
  relation(std::size_t target, std::size_t source, const std::vector<double>& places)
  {
    ScanRelation result;
    result.target = target;
    result.source = source;
    double probability = 0.8;
    for (const double x : places) {
      RelativePose pose;
      pose.T_target_source.translation.x() = target < source ? x : -x;
      pose.probability = probability;
      probability /= 8;
      result.poses.push_back(pose);
    }
    return result;
  }

  static std::vector<PairVotes>
  votes(const std::vector<ScanRelation>& relations)
  {
    MapScan scan;
    scan.spacing = 0.1;
    return votesOf(relations, {scan, scan});
  }
};

TEST_F(WaysOfAPair, TheOtherWayIsTheReverse)
{
  const auto there = votes({relation(0, 1, {2})}), back = votes({relation(1, 0, {2})});
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].target, 0u);
  EXPECT_EQ(back[0].source, 1u);
  EXPECT_LT((there[0].votes[0].T_target_source.matrix() -
             back[0].votes[0].T_target_source.matrix())
                .norm(),
            1e-12);
}

TEST_F(WaysOfAPair, EachCountsByHalf)
{
  const auto both = votes({relation(0, 1, {2}), relation(1, 0, {5})});
  ASSERT_EQ(both.size(), 1u);
  ASSERT_EQ(both[0].votes.size(), 2u);
  EXPECT_DOUBLE_EQ(both[0].votes[0].probability, 0.4);
  EXPECT_DOUBLE_EQ(both[0].votes[1].probability, 0.4);
  EXPECT_NEAR(both[0].unsure(), 0.2, 1e-12);
}

TEST(Likeness, IsGreatestOfWhatIsTheSame)
{
  made::Random random(8);
  std::vector<std::vector<float>> rows(4);
  std::vector<Scan> scans;
  PairRegistration registration(BackendKind::Cpu, 1);
  std::vector<double> points;
  for (int i = 0; i < 300; ++i)
    for (int axis = 0; axis < 3; ++axis)
      points.push_back(random.uniform(0, 5));
  for (int s = 0; s < 4; ++s) {
    // Two kinds of scans: their descriptors have their weight in the one half or the other.
    for (int i = 0; i < 300 * 8; ++i)
      rows[s].push_back(
          static_cast<float>(random.uniform(0, (i % 8 < 4) == (s < 2) ? 1 : 0.2)));
    ScanInput<double> input;
    input.points.data = points.data();
    input.points.size = 300;
    input.features.data = rows[s].data();
    input.features.size = 300;
    input.features.dimension = 8;
    input.features.stride = 8;
    scans.push_back(registration.makeScan(input, 0.1));
  }
  scans.push_back(Scan());
  ThreadPool pool(2);
  const Likeness likeness(
      5, [&](std::size_t i) { return scans[i]; }, pool);
  EXPECT_NEAR(likeness(0, 0), 1, 1e-5);
  EXPECT_GT(likeness(0, 1), likeness(0, 2));
  EXPECT_GT(likeness(2, 3), likeness(1, 3));
  EXPECT_EQ(likeness(0, 4), 0);
  EXPECT_EQ(likeness.ranked(3).front(), 2u);
  EXPECT_EQ(likeness.ranked(3).size(), 4u);
}

/** \brief Surfaces of two scans, with memory for all, and for none. */
TEST(MapScans, SurfacesAreMadeAgainWhereThereIsNoRoom)
{
  const made::RoomScans room;
  PairRegistration registration(BackendKind::Cpu, 1);
  const std::vector<Scan> scans{registration.makeScan(room.targetInput(), 0.1),
                                registration.makeScan(room.sourceInput(), 0.1)};
  std::atomic<int> asked{0};
  const auto source = [&](std::size_t i) {
    ++asked;
    return scans[i];
  };
  const auto same = [](const Array<Eigen::Vector3f>& a,
                       const Array<Eigen::Vector3f>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  };
  ThreadPool pool(2);
  const MapScans roomy(2, source, pool), narrow(2, source, pool, 1);
  EXPECT_EQ(asked, 4);
  for (int round = 0; round < 3; ++round) {
    const TwoClouds kept = roomy.clouds(0, 1), made = narrow.clouds(0, 1);
    EXPECT_EQ(asked, 4 + 2 * (round + 1));
    EXPECT_TRUE(same(kept.source->points, made.source->points));
    EXPECT_TRUE(same(kept.target->normals, made.target->normals));
    EXPECT_EQ(kept.spacing, made.spacing);
    EXPECT_EQ(kept.source, roomy.clouds(0, 1).source);
  }
  EXPECT_EQ(roomy[0].radius, narrow[0].radius);
  EXPECT_GT(roomy[0].radius, 0);
}

TEST(MapScans, OfABlindScanNoSpaceIsEmpty)
{
  const made::RoomScans room;
  PairRegistration registration(BackendKind::Cpu, 1);
  const Scan scan = registration.makeScan(room.targetInput(), 0.1);
  ThreadPool pool(1);
  MapScans scans(
      2, [&](std::size_t) { return scan; }, pool);
  EXPECT_TRUE(scans.clouds(0, 1).pair().oriented());
  scans.setBlind({true, false});
  EXPECT_FALSE(scans.clouds(0, 1).source->free_space.known());
  EXPECT_TRUE(scans.clouds(0, 1).target->free_space.known());
  scans.setBlind({false, false});
  EXPECT_TRUE(scans.clouds(0, 1).pair().oriented());
}

} // namespace
} // namespace pcl_flashreg
