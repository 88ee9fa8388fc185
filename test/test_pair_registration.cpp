// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The way from two clouds to a pose, entered at every door.

#include "support/made_scans.h"

#include <pcl_flashreg/pair_registration.h>
#include <pcl_flashreg/resolution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace pcl_flashreg {
namespace {

using made::RoomScans;

constexpr double V = RoomScans::RESOLUTION;

const RoomScans&
room()
{
  static const RoomScans scans;
  return scans;
}

PairOptions
atResolution(double resolution = V)
{
  PairOptions options;
  options.resolution = resolution;
  return options;
}

bool
same(const PairResult& a, const PairResult& b)
{
  return a.pose.T_target_source.toMatrix<double>() ==
             b.pose.T_target_source.toMatrix<double>() &&
         a.pose.confidence == b.pose.confidence && a.pose.inliers == b.pose.inliers;
}

class PairRegistrationTest : public testing::Test {
protected:
  void
  expectFound(const PairResult& result) const
  {
    EXPECT_EQ(result.pose.status, Status::Ok);
    EXPECT_TRUE(result.pose.converged) << result.pose.confidence;
    EXPECT_LT(room().error(result.pose.T_target_source), 0.5 * V);
  }

  PairRegistration registration{BackendKind::Cpu, 2};
  ScanInput<double> source = room().sourceInput(), target = room().targetInput();
};

/** \brief A scan in a map of ten rooms is seen in the detail that it has; what is a thousand
 * times as large is in another unit. */
TEST_F(PairRegistrationTest, APartDecidesOnTheResolution)
{
  std::vector<double> rooms;
  for (int i = 0; i < 10; ++i)
    for (std::size_t k = 0; k < room().target.size(); k += 3)
      RoomScans::append(rooms,
                        Eigen::Map<const Eigen::Vector3d>(&room().target[k]) +
                            Eigen::Vector3d(6.0 * i, 0, 0));
  const ScanInput<double> map = RoomScans::inputOf(rooms, room().target_viewpoint);
  const double of_room = registration.chooseResolution(source, source);
  const double of_map = registration.chooseResolution(map, map);
  ASSERT_GT(of_map, 2 * of_room);
  EXPECT_EQ(registration.chooseResolution(source, map), of_room);
  EXPECT_EQ(registration.chooseResolution(map, source), of_room);
  std::vector<double> in_millimetres = room().target;
  for (double& coordinate : in_millimetres)
    coordinate *= 1000;
  EXPECT_GT(registration.chooseResolution(
                source, RoomScans::inputOf(in_millimetres, room().target_viewpoint)),
            10.0);
}

TEST_F(PairRegistrationTest, GoesFromCloudsToAPose)
{
  const PairResult result = registration.align(source, target, atResolution());
  expectFound(result);
  EXPECT_EQ(result.resolution, V);
  EXPECT_FALSE(result.source_estimate);
  EXPECT_EQ(result.parameters.inlier_distance, static_cast<float>(2 * V));
  EXPECT_EQ(result.matches.size(), result.source.size());
  EXPECT_EQ(result.correspondences, result.matches.size());
  EXPECT_TRUE(result.pose.evidence.has_clouds);
  EXPECT_TRUE(result.pose.evidence.has_viewpoints);
  for (const int row : result.pose.inliers) {
    const FeatureMatch& match = result.matches[static_cast<std::size_t>(row)];
    const Eigen::Vector3d moved =
        result.pose.T_target_source.toIsometry() *
        result.source.point(static_cast<std::size_t>(match.query));
    EXPECT_LT(
        (moved - result.target.point(static_cast<std::size_t>(match.match))).norm(),
        2 * V);
  }
  const PairTimings& timings = result.timings;
  EXPECT_EQ(timings.resolution, 0);
  EXPECT_GT(timings.source.voxel_grid, 0);
  EXPECT_GT(timings.target.feature_histograms, 0);
  EXPECT_GT(timings.matching, 0);
  EXPECT_GT(timings.estimation.total, 0);
  EXPECT_GT(timings.total, timings.matching + timings.estimation.total);
}

TEST_F(PairRegistrationTest, GivesTheSameFromScansThatWereMadeBefore)
{
  const PairResult at_once = registration.align(source, target, atResolution());
  PairRegistration other(BackendKind::Cpu, 1);
  const Scan from = other.makeScan(source, V), to = other.makeScan(target, V);
  EXPECT_TRUE(same(at_once, registration.align(from, to)));
  EXPECT_TRUE(same(at_once, other.align(from, to)));
  const Correspondences matched =
      toCorrespondences(from, to, registration.match(from, to));
  EXPECT_TRUE(same(at_once, registration.align(from, to, matched.view())));
  EXPECT_EQ(at_once.resolution, registration.align(from, to).resolution);
}

TEST_F(PairRegistrationTest, TakesTheCoarserOfTwoEstimatedResolutions)
{
  const RoomScans fine(1, 1600);
  const ScanInput<double> finer = fine.targetInput();
  PairOptions options;
  const PairResult result = registration.align(source, finer, options);
  ASSERT_TRUE(result.source_estimate && result.target_estimate);
  EXPECT_EQ(result.resolution,
            std::max(*result.source_estimate, *result.target_estimate));
  EXPECT_EQ(result.resolution, registration.chooseResolution(source, finer));
  EXPECT_GT(result.timings.resolution, 0);
  const Scan a = registration.makeScan(source, 0.1),
             b = registration.makeScan(target, 0.12);
  EXPECT_EQ(registration.align(a, b).resolution, 0.12);
}

TEST_F(PairRegistrationTest, AsksTheCloudsOfDescriptorsThatAreGiven)
{
  // FPFH, but as somebody else's: without a word of normals.
  const Scan from = registration.makeScan(source, V),
             to = registration.makeScan(target, V);
  const auto keypoints = [](const Scan& scan, const Eigen::Vector3d& viewpoint) {
    ScanInput<float> input;
    input.points.data = scan.points();
    input.points.size = scan.size();
    input.features = scan.features();
    input.viewpoint = viewpoint;
    input.viewpoint_known = true;
    return input;
  };
  const auto given_source = keypoints(from, room().source_viewpoint);
  const auto given_target = keypoints(to, room().target_viewpoint);
  const PairResult result =
      registration.align(given_source, given_target, atResolution());
  expectFound(result);
  EXPECT_TRUE(result.pose.evidence.has_clouds);
  EXPECT_TRUE(result.pose.evidence.has_viewpoints);
  PairOptions fast = atResolution();
  fast.cloud_check = false;
  EXPECT_FALSE(
      registration.align(given_source, given_target, fast).pose.evidence.has_clouds);

  // The spacing of keypoints tells their resolution.
  const PairResult estimated = registration.align(given_source, given_target);
  EXPECT_NEAR(estimated.resolution, V, 0.3 * V);

  auto without = given_target;
  without.features = {};
  EXPECT_THROW(registration.align(given_source, without), std::invalid_argument);
}

/** \brief Twelve right correspondences among 300: too few to be trusted by themselves. */
class FewRight : public PairRegistrationTest {
protected:
  FewRight()
  {
    const Scan from = registration.makeScan(source, V),
               to = registration.makeScan(target, V);
    made::Random random(3);
    const auto any = [&](const Scan& scan) {
      return scan.point(static_cast<std::size_t>(
          random.uniform(0, static_cast<double>(scan.size()))));
    };
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d s = any(from);
      const Eigen::Vector3d t =
          i < 12 ? Eigen::Vector3d(room().T_target_source * s) : any(to);
      RoomScans::append(given.source, s);
      RoomScans::append(given.target, t);
    }
  }

  Correspondences given;
};

TEST_F(FewRight, AreTrustedOnTheWordOfTheClouds)
{
  const PairResult alone = registration.align(
      ScanInput<double>(), ScanInput<double>(), given.view(), atResolution());
  EXPECT_FALSE(alone.pose.converged);
  EXPECT_FALSE(alone.pose.evidence.has_clouds);
  EXPECT_TRUE(alone.source.empty());

  const PairResult asked =
      registration.align(source, target, given.view(), atResolution());
  expectFound(asked);
  EXPECT_TRUE(asked.pose.evidence.has_clouds);
  EXPECT_EQ(asked.source.features().dimension, 0u) << "nobody needs descriptors";
  EXPECT_TRUE(asked.matches.empty());
  EXPECT_EQ(asked.correspondences, 300u);

  PairOptions fast = atResolution();
  fast.cloud_check = false;
  EXPECT_TRUE(same(alone, registration.align(source, target, given.view(), fast)));
}

TEST_F(FewRight, TellTheResolutionByTheirSpacing)
{
  const PairResult result = registration.align(source, target, given.view());
  const PointView none;
  EXPECT_GT(result.resolution, V);
  EXPECT_EQ(registration.align(source, target, CorrespondenceView<double>{}).resolution,
            0)
      << "none can tell none";
  EXPECT_EQ(
      registration.align(source, target, CorrespondenceView<double>{}).pose.status,
      Status::TooFewCorrespondences);
}

TEST_F(PairRegistrationTest, UsesTheFreeSpaceOfOneSideAlone)
{
  PairOptions options = atResolution();
  const PairResult both = registration.align(source, target, options);
  for (ScanInput<double>* blind : {&source, &target}) {
    blind->viewpoint_known = false;
    const PairResult one = registration.align(source, target, options);
    expectFound(one);
    EXPECT_TRUE(one.pose.evidence.has_viewpoints);
    EXPECT_TRUE(one.pose.evidence.one_viewpoint);
    blind->viewpoint_known = true;
  }
  EXPECT_FALSE(both.pose.evidence.one_viewpoint);
  source.viewpoint_known = target.viewpoint_known = false;
  const PairResult neither = registration.align(source, target, options);
  EXPECT_FALSE(neither.pose.evidence.has_viewpoints);
  EXPECT_FALSE(neither.pose.evidence.one_viewpoint);
  EXPECT_LT(room().error(neither.pose.T_target_source), 0.5 * V);
}

TEST_F(PairRegistrationTest, LooksASecondTimeWhereThereIsDoubt)
{
  PairOptions once = atResolution();
  once.second_look = false;
  const PairResult first = registration.align(source, target, once);
  const PairResult sure = registration.align(source, target, atResolution());
  EXPECT_TRUE(same(first, sure)) << "there was no doubt";
  EXPECT_EQ(sure.pose.timings_ms.second_look, 0);
  EXPECT_EQ(sure.pose.evidence.inliers, static_cast<double>(sure.pose.inliers.size()));

  // A second look that finds nothing more certain changes nothing.
  PairOptions twice = atResolution();
  twice.parameters.min_confidence = 1;
  const PairResult second = registration.align(source, target, twice);
  EXPECT_GT(second.pose.timings_ms.second_look, 0);
  EXPECT_FALSE(second.pose.converged);
  EXPECT_LT(room().error(second.pose.T_target_source), 0.5 * V);
  EXPECT_GT(second.pose.confidence, 0.6);
  EXPECT_TRUE(same(first, second));
  EXPECT_FALSE(second.pose.evidence.second_look);
}

TEST_F(PairRegistrationTest, LooksOnceAtWhatIsNotItsOwn)
{
  PairOptions doubting = atResolution();
  doubting.parameters.min_confidence = 1;
  const Scan from = registration.makeScan(source, V),
             to = registration.makeScan(target, V);
  const std::vector<FeatureMatch> matches = registration.match(from, to);
  const Correspondences given = toCorrespondences(from, to, matches);
  EXPECT_EQ(
      registration.align(from, to, given.view(), doubting).pose.timings_ms.second_look,
      0);
  const PairResult own = registration.align(from, to, matches, doubting);
  EXPECT_GT(own.pose.timings_ms.second_look, 0);
  EXPECT_TRUE(same(own, registration.align(from, to, doubting)));
  doubting.mutual = true;
  EXPECT_EQ(registration.align(from, to, doubting).pose.timings_ms.second_look, 0);
  doubting.mutual = false;
  doubting.cloud_check = false;
  EXPECT_EQ(registration.align(from, to, doubting).pose.timings_ms.second_look, 0);

  for (const FeatureMatch& wrong :
       {FeatureMatch{-1, 0, 0},
        FeatureMatch{0, static_cast<std::int32_t>(to.size()), 0}})
    EXPECT_THROW(registration.align(from, to, std::vector{wrong}),
                 std::invalid_argument);
}

TEST_F(PairRegistrationTest, FindsFromTheOtherSideWhatOneSideDoesNotShow)
{
  // Not one right match in the first look: each points to where its point is not.
  const Scan from = registration.makeScan(source, V),
             to = registration.makeScan(target, V);
  made::Random random(5);
  std::vector<FeatureMatch> wrong;
  for (std::size_t i = 0; i < from.size(); ++i)
    wrong.push_back(
        {static_cast<std::int32_t>(i),
         static_cast<std::int32_t>(random.uniform(0, static_cast<double>(to.size()))),
         0});
  PairOptions options;
  options.second_look = false;
  EXPECT_FALSE(registration.align(from, to, wrong, options).pose.converged);
  options.second_look = true;
  const PairResult result = registration.align(from, to, wrong, options);
  EXPECT_LT(room().error(result.pose.T_target_source), 0.5 * V);
  EXPECT_TRUE(result.pose.converged) << result.pose.confidence;
  EXPECT_TRUE(result.pose.evidence.second_look);
  // Matches of both sides say how many agree; the rows are those of the first.
  EXPECT_GT(result.pose.evidence.inliers,
            static_cast<double>(result.pose.inliers.size()));
  EXPECT_EQ(result.matches.size(), wrong.size());
  EXPECT_LT(static_cast<std::size_t>(result.pose.inliers.back()),
            result.matches.size());
  PairRegistration alone(BackendKind::Cpu, 1);
  EXPECT_TRUE(same(result, alone.align(from, to, wrong, options)));
}

TEST_F(PairRegistrationTest, MatchesAsItIsTold)
{
  const Scan from = registration.makeScan(source, V),
             to = registration.makeScan(target, V);
  PairOptions options;
  options.neighbors = 3;
  EXPECT_EQ(registration.match(from, to, options).size(), 3 * from.size());
  options.neighbors = 1;
  options.mutual = true;
  const auto mutual = registration.match(from, to, options);
  const auto expected = matchFeaturesBothWays(from.features(), to.features()).mutual();
  ASSERT_EQ(mutual.size(), expected.size());
  EXPECT_LT(mutual.size(), from.size());
  expectFound(registration.align(from, to, options));
}

TEST_F(PairRegistrationTest, TriesAGuess)
{
  // No clique spans so much; the guess is the only hypothesis.
  PairOptions options = atResolution();
  options.min_length_sum = 1000.0f;
  EXPECT_EQ(registration.align(source, target, options).pose.status, Status::NoClique);
  RigidTransform guess;
  guess.rotation = room().T_target_source.linear();
  guess.translation = room().T_target_source.translation();
  options.guess = guess;
  const PairResult result = registration.align(source, target, options);
  EXPECT_EQ(result.pose.status, Status::Ok);
  EXPECT_LT(room().error(result.pose.T_target_source), 0.5 * V);
}

TEST_F(PairRegistrationTest, TellsItsStepsAndCanBeStopped)
{
  std::vector<PairStep> steps;
  PairOptions options;
  options.on_step = [&](const PairProgress& at) {
    steps.push_back(at.step);
    EXPECT_EQ(at.resolution > 0, at.step != PairStep::Resolution);
    EXPECT_EQ(at.target_keypoints > 0, at.step >= PairStep::Matching);
    EXPECT_EQ(at.correspondences > 0, at.step == PairStep::Estimation);
  };
  registration.align(source, target, options);
  EXPECT_EQ(steps,
            (std::vector<PairStep>{PairStep::Resolution,
                                   PairStep::SourceScan,
                                   PairStep::TargetScan,
                                   PairStep::Matching,
                                   PairStep::Estimation}));
  options.on_step = [](const PairProgress& at) {
    if (at.step == PairStep::Matching)
      throw std::runtime_error("enough");
  };
  EXPECT_THROW(registration.align(source, target, options), std::runtime_error);
  expectFound(registration.align(source, target, atResolution()));
}

TEST_F(PairRegistrationTest, OfLargeCoordinatesIsAsGood)
{
  const Eigen::Vector3d away(4.5e5, 5.4e6, 120);
  std::vector<double> far = room().target;
  for (std::size_t i = 0; i < far.size(); ++i)
    far[i] += away[i % 3];
  const PairResult result = registration.align(
      source, RoomScans::inputOf(far, room().target_viewpoint + away), atResolution());
  RigidTransform back = result.pose.T_target_source;
  back.translation -= away;
  EXPECT_TRUE(result.pose.converged);
  EXPECT_LT(room().error(back), 0.5 * V);
}

TEST_F(PairRegistrationTest, OfNothingFindsNothing)
{
  const PairResult result =
      registration.align(ScanInput<double>(), target, atResolution());
  EXPECT_EQ(result.pose.status, Status::TooFewCorrespondences);
  EXPECT_THROW(registration.align(ScanInput<double>(), target), std::invalid_argument)
      << "nothing has no resolution";
  EXPECT_EQ(registration.align(Scan(), Scan()).pose.status,
            Status::TooFewCorrespondences);
}

TEST_F(PairRegistrationTest, RefusesOptionsThatMakeNoSense)
{
  PairOptions options = atResolution(-1);
  EXPECT_THROW(registration.align(source, target, options), std::invalid_argument);
  options = atResolution();
  options.neighbors = 0;
  EXPECT_THROW(registration.align(source, target, options), std::invalid_argument);
  options = atResolution();
  options.inlier_distance = -1.0f;
  EXPECT_THROW(registration.align(source, target, options), std::invalid_argument);
  options = atResolution();
  options.parameters.pivots = 0;
  EXPECT_THROW(registration.align(source, target, options), std::invalid_argument);
  expectFound(registration.align(source, target, atResolution()));
}

} // namespace
} // namespace pcl_flashreg
