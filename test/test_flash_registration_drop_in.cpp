// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// A program for pcl::SampleConsensusPrerejective in which only the type changes.

#if defined(__GNUC__) && !defined(__clang__)
// Inside PCL and Eigen: reads of four floats that the compiler takes for one too many.
#pragma GCC diagnostic ignored "-Warray-bounds"
#endif

#include <pcl_flashreg/flash_registration.h>

#include <pcl/registration/sample_consensus_prerejective.h>

#include "pcl_fixtures.h"

using namespace pcl_flashreg;
using PointT = pcl::PointXYZ;
using Cloud = pcl::PointCloud<PointT>;
using FeatureT = pcl::FPFHSignature33;

namespace {

constexpr float leaf = made::room_resolution;

struct Outcome {
  Eigen::Matrix4f pose;
  bool converged;
  std::size_t inliers, source_points;
  double fitness;
  Cloud aligned;
};

template <typename Align>
Outcome
runProgram(const FpfhCloud& object, const FpfhCloud& scene)
{
  typename Align::Ptr align(new Align);
  align->setInputSource(object.points);
  align->setSourceFeatures(object.features);
  align->setInputTarget(scene.points);
  align->setTargetFeatures(scene.features);
  align->setMaximumIterations(3000);
  align->setNumberOfSamples(3);
  align->setCorrespondenceRandomness(1);
  align->setSimilarityThreshold(0.9f);
  align->setMaxCorrespondenceDistance(1.5f * leaf);
  align->setInlierFraction(0.25f);
  Outcome outcome;
  align->align(outcome.aligned);
  outcome.converged = align->hasConverged();
  outcome.pose = align->getFinalTransformation();
  outcome.inliers = align->getInliers().size();
  outcome.source_points = align->getSourceFeatures()->size();
  outcome.fitness = align->getFitnessScore(2.25 * leaf * leaf);
  EXPECT_EQ(align->getTargetFeatures(), scene.features);
  EXPECT_EQ(align->getNumberOfSamples(), 3);
  EXPECT_EQ(align->getCorrespondenceRandomness(), 1);
  EXPECT_FLOAT_EQ(align->getSimilarityThreshold(), 0.9f);
  EXPECT_FLOAT_EQ(align->getInlierFraction(), 0.25f);
  EXPECT_EQ(align->getMaximumIterations(), 3000);
  return outcome;
}

template <typename Align>
class DropIn : public testing::Test {
};

using Aligns =
    testing::Types<pcl::SampleConsensusPrerejective<PointT, PointT, FeatureT>,
                   FlashRegistration<PointT, PointT, FeatureT>>;
TYPED_TEST_SUITE(DropIn, Aligns);

} // namespace

TYPED_TEST(DropIn, AlignsTheRoom)
{
  const made::RoomPairXYZ pair;
  const FpfhCloud object = computeFpfh(*pair.source, {}, leaf);
  const FpfhCloud scene = computeFpfh(*pair.target, {}, leaf);
  const Outcome outcome = runProgram<TypeParam>(object, scene);
  EXPECT_TRUE(outcome.converged);
  EXPECT_LT(made::rotationError(outcome.pose, pair.T_target_source), 5);
  EXPECT_LT(made::positionError(outcome.pose, pair.T_target_source), 0.15);
  EXPECT_EQ(outcome.aligned.size(), object.points->size());
  EXPECT_EQ(outcome.source_points, object.points->size());
  EXPECT_GT(outcome.inliers, object.points->size() / 4);
  EXPECT_LT(outcome.inliers, object.points->size());
  EXPECT_LT(outcome.fitness, leaf * leaf);
}
