// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Scans of known relative motion in a map that has the same hall twice.

#include "support/twin_halls.h"

#include <pcl_flashreg/sequence_localization.h>

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace pcl_flashreg {
namespace {

using made::TwinHalls;

class SequenceTest : public ::testing::Test {
protected:
  static const TwinHalls&
  halls()
  {
    static const TwinHalls halls;
    return halls;
  }

  static PairRegistration&
  registration()
  {
    static PairRegistration registration(BackendKind::Cpu, 2);
    return registration;
  }

  static Scan
  makeScan(const std::vector<Eigen::Vector3d>& points, bool is_map, bool seen)
  {
    ScanInput<double> input;
    input.points.data = points.front().data();
    input.points.size = points.size();
    input.many_viewpoints = is_map;
    input.viewpoint_known = seen;
    return registration().makeScan(input, TwinHalls::RESOLUTION);
  }

  static const ScanIndex&
  map()
  {
    static const ScanIndex index =
        registration().makeIndex(makeScan(halls().map, true, false));
    return index;
  }

  /** \brief Scans with what each alone was found to be. */
  static const std::vector<SequenceScan>&
  all()
  {
    static const std::vector<SequenceScan> scans = [] {
      std::vector<SequenceScan> made;
      const std::vector<RigidTransform> poses = halls().odometry();
      for (std::size_t i = 0; i < poses.size(); ++i) {
        const Scan scan = makeScan(halls().scans[i], false, i < 3);
        made.push_back(
            {scan, poses[i], registration().align(scan, map(), forSequence({})).pose});
      }
      return made;
    }();
    return scans;
  }

  static std::vector<SequenceScan>
  withOdometry(const std::vector<RigidTransform>& poses)
  {
    std::vector<SequenceScan> scans = all();
    for (std::size_t i = 0; i < scans.size(); ++i)
      scans[i].T_sequence_scan = poses[i];
    return scans;
  }

  static void
  expectFound(const SequenceResult& result)
  {
    EXPECT_TRUE(result.converged) << result.confidence;
    ASSERT_FALSE(result.placements.empty());
    const SequencePlacement& best = result.placements.front();
    ASSERT_EQ(best.T_map_scan.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT(halls().errorOf(best.T_map_scan[i], i), 0.05) << i;
  }
};

TEST_F(SequenceTest, aScanOfTwinHallsIsNotTrustedAlone)
{
  for (std::size_t i = 0; i < 3; ++i) {
    const Result& alone = all()[i].alone;
    EXPECT_FALSE(alone.converged) << i << ": " << alone.confidence;
    EXPECT_GT(alone.evidence.rivals, 0.3) << i;
  }
  EXPECT_TRUE(all()[3].alone.converged) << all()[3].alone.confidence;
}

TEST_F(SequenceTest, oneScanTellsWhereAllAre)
{
  const SequenceResult result = localizeSequence(all(), map(), {}, 2);
  expectFound(result);
  const SequencePlacement& best = result.placements.front();
  const Eigen::Vector3d far(0.6, 0.6, 0.6);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Isometry3d T =
        best.T_map_sequence.toIsometry() * all()[i].T_sequence_scan.toIsometry();
    EXPECT_LT((T * far - halls().T_map_scan[i] * far).norm(), 0.05) << i;
  }
  EXPECT_EQ(best.supporters, 4u);
  EXPECT_EQ(best.agreement_of_scan.size(), 4u);
  EXPECT_GT(best.agreement.matched, 0.5);
  EXPECT_TRUE(result.evidence.in_map);
  EXPECT_TRUE(result.evidence.has_viewpoints);
}

TEST_F(SequenceTest, scansOfTwinHallsAloneHaveARival)
{
  const std::vector<SequenceScan> scans(all().begin(), all().begin() + 3);
  const SequenceResult result = localizeSequence(scans, map(), {}, 2);
  EXPECT_FALSE(result.converged) << result.confidence;
  EXPECT_GT(result.evidence.rivals, 0.3);
  ASSERT_GE(result.placements.size(), 2u);
  const Eigen::Vector3d between = result.placements[0].T_map_scan[0].translation -
                                  result.placements[1].T_map_scan[0].translation;
  EXPECT_NEAR(between.norm(), 20, 0.1);
}

TEST_F(SequenceTest, odometryMayDrift)
{
  expectFound(localizeSequence(withOdometry(halls().odometry(0.08)), map(), {}, 2));
}

TEST_F(SequenceTest, theSameOnAnyNumberOfThreads)
{
  const SequenceResult one = localizeSequence(all(), map(), {}, 1);
  const SequenceResult three = localizeSequence(all(), map(), {}, 3);
  EXPECT_EQ(one.confidence, three.confidence);
  ASSERT_EQ(one.placements.size(), three.placements.size());
  for (std::size_t i = 0; i < one.placements.size(); ++i)
    EXPECT_EQ(one.placements[i].T_map_sequence.toMatrix<double>(),
              three.placements[i].T_map_sequence.toMatrix<double>());
}

TEST_F(SequenceTest, uprightPosesStayUpright)
{
  PairOptions options;
  options.parameters.motion = MotionModel::Upright;
  options.parameters.max_tilt = 1;
  const SequenceResult result = localizeSequence(all(), map(), options, 2);
  expectFound(result);
  for (const RigidTransform& T : result.placements.front().T_map_scan)
    EXPECT_GT(T.rotation(2, 2), std::cos(1.001 * 3.14159265 / 180));
}

TEST_F(SequenceTest, whatNobodyHasAnyIdeaOfIsNotFound)
{
  EXPECT_TRUE(localizeSequence({}, map()).placements.empty());
  std::vector<SequenceScan> scans = all();
  for (SequenceScan& scan : scans)
    scan.alone = Result();
  const SequenceResult result = localizeSequence(scans, map());
  EXPECT_TRUE(result.placements.empty());
  EXPECT_FALSE(result.converged);
  EXPECT_EQ(result.confidence, 0);
  EXPECT_TRUE(localizeSequence(all(), ScanIndex()).placements.empty());
}

TEST_F(SequenceTest, aScanOfWhichNothingIsKnownIsCarriedAlong)
{
  std::vector<SequenceScan> scans = all();
  scans[1].scan = Scan();
  scans[1].alone = Result();
  expectFound(localizeSequence(scans, map(), {}, 2));
  // One alone, too.
  const SequenceResult result = localizeSequence({all()[3]}, map(), {}, 2);
  EXPECT_TRUE(result.converged) << result.confidence;
  EXPECT_LT(halls().errorOf(result.placements.front().T_map_scan.front(), 3), 0.05);
}

TEST_F(SequenceTest, refusesPosesThatAreNoNumbers)
{
  std::vector<SequenceScan> scans = all();
  scans[2].T_sequence_scan.translation.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(localizeSequence(scans, map()), std::invalid_argument);
  PairOptions options;
  options.parameters.min_confidence = 2;
  EXPECT_THROW(localizeSequence(all(), map(), options), std::invalid_argument);
}

} // namespace
} // namespace pcl_flashreg
