// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#if defined(__GNUC__) && !defined(__clang__)
// Inside PCL and Eigen: reads of four floats that the compiler takes for one too many.
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif

#include <pcl_flashreg/correspondence_rejector_flashreg.h>

#include <pcl/common/transforms.h>
#include <pcl/registration/correspondence_rejection_sample_consensus.h>
#include <pcl/registration/icp.h>

#include "pcl_fixtures.h"

using namespace pcl_flashreg;
using PointT = pcl::PointXYZ;
using Cloud = pcl::PointCloud<PointT>;
using Rejector = CorrespondenceRejectorFlashReg<PointT>;

namespace {

constexpr int size = 300;

/** \brief Every third correspondence is right, to within some millimetres. */
class CorrespondenceRejectorTest : public testing::Test {
protected:
  CorrespondenceRejectorTest()
  {
    made::Random random(11);
    for (int i = 0; i < size; ++i) {
      const Eigen::Vector3d point = random.inCube(3);
      const Eigen::Vector3d noise(random.normal(), random.normal(), random.normal());
      const Eigen::Vector3d other =
          isRight(i) ? Eigen::Vector3d(point + 0.003 * noise) : random.inCube(3);
      source->push_back(made::RoomPairXYZ::toPoint<PointT>(point));
      target->push_back(made::RoomPairXYZ::toPoint<PointT>(made::roomPose() * other));
      correspondences->emplace_back(i, i, 0.5f);
    }
    rejector.setInputSource(source);
    rejector.setInputTarget(target);
  }

  static bool
  isRight(int i)
  {
    return i % 3 == 0;
  }

  static bool
  same(const pcl::Correspondences& a, const pcl::Correspondences& b)
  {
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [](const auto& x, const auto& y) {
             return x.index_query == y.index_query && x.index_match == y.index_match &&
                    x.distance == y.distance;
           });
  }

  /** \brief Nothing was rejected, and no transform is left of an earlier call. */
  void
  expectAllKept(const pcl::Correspondences& original)
  {
    const made::Silence silence;
    pcl::Correspondences remaining;
    rejector.getRemainingCorrespondences(original, remaining);
    EXPECT_TRUE(same(remaining, original));
    EXPECT_TRUE(rejector.getBestTransformation().isIdentity(0));
    pcl::Indices inliers{1, 2};
    rejector.getInliersIndices(inliers);
    EXPECT_TRUE(inliers.empty());
  }

  Cloud::Ptr source{new Cloud}, target{new Cloud};
  pcl::CorrespondencesPtr correspondences{new pcl::Correspondences};
  Rejector rejector;
};

} // namespace

TEST_F(CorrespondenceRejectorTest, KeepsTheRightOnes)
{
  rejector.setSaveInliers(true);
  rejector.setInputCorrespondences(correspondences);
  pcl::Correspondences remaining;
  rejector.getCorrespondences(remaining);
  pcl::Indices inliers;
  rejector.getInliersIndices(inliers);
  ASSERT_EQ(inliers.size(), remaining.size());
  int right = 0;
  for (std::size_t i = 0; i < remaining.size(); ++i) {
    EXPECT_EQ(remaining[i].index_query, inliers[i]);
    EXPECT_EQ(remaining[i].distance, 0.5f);
    right += isRight(remaining[i].index_query);
  }
  EXPECT_EQ(right, size / 3);
  EXPECT_LT(remaining.size(), size / 3 + 10u);
  EXPECT_LT((rejector.getBestTransformation() - made::roomPose().matrix().cast<float>())
                .norm(),
            0.01);
  EXPECT_TRUE(rejector.getResult().converged);
}

TEST_F(CorrespondenceRejectorTest, AgreesWithPclsClass)
{
  pcl::registration::CorrespondenceRejectorSampleConsensus<PointT> reference;
  reference.setInputSource(source);
  reference.setInputTarget(target);
  reference.setInlierThreshold(0.05);
  reference.setMaximumIterations(2000);
  pcl::Correspondences expected, remaining;
  reference.setRefineModel(true);
  reference.getRemainingCorrespondences(*correspondences, expected);
  rejector.setInlierThreshold(0.05);
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_NEAR(
      static_cast<double>(remaining.size()), static_cast<double>(expected.size()), 3);
  EXPECT_LT(
      (rejector.getBestTransformation() - reference.getBestTransformation()).norm(),
      0.02);
}

TEST_F(CorrespondenceRejectorTest, TakesItsOutputAsInput)
{
  pcl::Correspondences both = *correspondences, remaining;
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  rejector.getRemainingCorrespondences(both, both);
  EXPECT_TRUE(same(both, remaining));
}

TEST_F(CorrespondenceRejectorTest, KeepsAllWithinTheThresholdEvenBeyondTheMaximum)
{
  Parameters parameters;
  parameters.max_correspondences = 150;
  rejector.setParameters(parameters);
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_EQ(rejector.getResult().correspondences_dropped, 150u);
  EXPECT_GE(remaining.size(), size / 3u);
}

TEST_F(CorrespondenceRejectorTest, TakesItsLengthsFromWhatIsSet)
{
  EXPECT_DOUBLE_EQ(rejector.getInlierThreshold(), 0.05f);
  EXPECT_FLOAT_EQ(rejector.getParameters().length_tolerance, 0.24f * 0.025f);
  rejector.setResolution(0.1);
  EXPECT_FLOAT_EQ(rejector.getParameters().inlier_distance, 0.2f);
  rejector.setInlierThreshold(0.07);
  EXPECT_FLOAT_EQ(rejector.getParameters().inlier_distance, 0.07f);
  EXPECT_FLOAT_EQ(rejector.getParameters().length_tolerance, 0.024f);
  rejector.setParameters(Parameters());
  EXPECT_FLOAT_EQ(rejector.getParameters().length_tolerance,
                  Parameters().length_tolerance);
  EXPECT_FLOAT_EQ(rejector.getParameters().inlier_distance, 0.07f);
}

TEST_F(CorrespondenceRejectorTest, KnowsWhichWayIsUp)
{
  const Eigen::Vector3d up(0, 0, 1);
  rejector.setMotion(MotionModel::Upright);
  rejector.setGravity(made::roomPose().linear().transpose() * up, up);
  rejector.setMaxTilt(1);
  EXPECT_EQ(rejector.getParameters().max_tilt, 1);
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_GE(remaining.size(), size / 3u);
  EXPECT_TRUE(rejector.getResult().converged);
}

TEST_F(CorrespondenceRejectorTest, SavesInliersOnlyWhereAsked)
{
  pcl::Correspondences remaining;
  pcl::Indices inliers;
  EXPECT_FALSE(rejector.getSaveInliers());
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  rejector.getInliersIndices(inliers);
  EXPECT_TRUE(inliers.empty());
}

TEST_F(CorrespondenceRejectorTest, RejectsNothingWhereItFindsNothing)
{
  pcl::Correspondences remaining;
  rejector.setSaveInliers(true);
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  ASSERT_FALSE(rejector.getBestTransformation().isIdentity(0));

  expectAllKept({});
  expectAllKept({(*correspondences)[0], (*correspondences)[3]});
  pcl::Correspondences one_point(20, (*correspondences)[0]);
  expectAllKept(one_point);
}

TEST_F(CorrespondenceRejectorTest, SurvivesWhatMakesNoSense)
{
  rejector.setSaveInliers(true);
  pcl::Correspondences outside = *correspondences;
  outside[7].index_match = size;
  expectAllKept(outside);
  rejector.setInlierThreshold(-1);
  expectAllKept(*correspondences);
  rejector.setInlierThreshold(0.05);
  rejector.setResolution(-1);
  expectAllKept(*correspondences);
  rejector.setResolution(0);
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_LT(remaining.size(), correspondences->size());
}

TEST_F(CorrespondenceRejectorTest, RejectsWhatHasNoMatchOrIsNotFinite)
{
  (*correspondences)[3].index_match = -1;
  made::spoil(*source, 6);
  made::spoil(*target, 9);
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_GE(remaining.size(), size / 3 - 3u);
  for (const auto& correspondence : remaining)
    EXPECT_TRUE(correspondence.index_query != 3 && correspondence.index_query != 6 &&
                correspondence.index_query != 9);
}

TEST_F(CorrespondenceRejectorTest, WithoutACloudLeavesTheOutputAsItIs)
{
  const made::Silence silence;
  Rejector without_clouds;
  pcl::Correspondences remaining(2);
  without_clouds.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_EQ(remaining.size(), 2u);
  without_clouds.setInputSource(source);
  without_clouds.getRemainingCorrespondences(*correspondences, remaining);
  EXPECT_EQ(remaining.size(), 2u);
  EXPECT_TRUE(without_clouds.getBestTransformation().isIdentity(0));
}

TEST(CorrespondenceRejectorIcp, WorksInsideIt)
{
  const made::RoomPairXYZ pair;
  // From some centimetres and degrees off the truth.
  Eigen::Isometry3d off = pair.T_target_source;
  off.rotate(Eigen::AngleAxisd(0.03, Eigen::Vector3d::UnitZ()));
  off.pretranslate(Eigen::Vector3d(0.05, -0.04, 0.03));
  const Rejector::Ptr rejector(new Rejector);
  rejector->setInlierThreshold(0.1);
  pcl::IterativeClosestPoint<PointT, PointT> icp;
  icp.setInputSource(pair.source);
  icp.setInputTarget(pair.target);
  icp.setMaxCorrespondenceDistance(0.3);
  icp.setMaximumIterations(25);
  icp.addCorrespondenceRejector(rejector);
  Cloud aligned;
  icp.align(aligned, off.matrix().cast<float>());
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_LT(made::rotationError(icp.getFinalTransformation(), pair.T_target_source),
            0.5);
  EXPECT_LT(made::positionError(icp.getFinalTransformation(), pair.T_target_source),
            0.02);
  EXPECT_TRUE(rejector->getInputSource() && rejector->getInputTarget());
  EXPECT_FALSE(rejector->getResult().inliers.empty());
}
