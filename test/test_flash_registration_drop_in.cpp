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

namespace {

/** \brief An object of 15 cm, two samples of it that lack other parts. */
struct ObjectPair {
  Cloud::Ptr source{new Cloud}, target{new Cloud};
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();

  ObjectPair()
  {
    const made::RoomPairXYZ room(12, 3);
    constexpr float scale = 0.05f;
    for (const auto& point : *room.source) {
      const Eigen::Vector3d there =
          room.T_target_source * point.getVector3fMap().cast<double>();
      source->push_back(made::RoomPairXYZ::toPoint<PointT>(scale * there));
    }
    for (const auto& point : *room.target)
      target->push_back(made::RoomPairXYZ::toPoint<PointT>(
          scale * point.getVector3fMap().cast<double>()));
    T_target_source.rotate(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitZ()));
    T_target_source.pretranslate(Eigen::Vector3d(-100, 0, 0));
    pcl::transformPointCloud(
        *source, *source, Eigen::Matrix4d(T_target_source.inverse().matrix()));
  }
};

/** \brief With normals from a third of the object, and histograms as wide. */
detail::Fpfh33::Ptr
describeWidely(const Cloud::Ptr& cloud)
{
  const auto normals = detail::estimateNormals(cloud, 0.05, 1);
  return detail::estimateFpfh(cloud, normals, 0.05, 1);
}

} // namespace

/** \brief A program for pcl::SampleConsensusInitialAlignment: within its distance of 0.1
 * every pose has all inliers, so that only the clouds can tell which is right. */
TEST(SacIa, AlignsAnObjectOfWhichEveryPoseHasAllInliers)
{
  const ObjectPair pair;
  using Align = FlashRegistration<PointT, PointT, FeatureT>;
  Align align;
  align.setMinSampleDistance(0.05f);
  align.setMaxCorrespondenceDistance(0.1);
  align.setMaximumIterations(1000);
  align.setNumberOfSamples(3);
  align.setErrorFunction(Align::ErrorFunctorPtr(new Align::TruncatedError(0.01f)));
  align.setInputSource(pair.source);
  align.setInputTarget(pair.target);
  align.setSourceFeatures(describeWidely(pair.source));
  align.setTargetFeatures(describeWidely(pair.target));
  Cloud aligned;
  align.align(aligned);
  EXPECT_EQ(aligned.size(), pair.source->size());
  EXPECT_EQ(align.getInliers().size(), pair.source->size());
  EXPECT_LT(align.getFitnessScore(), 0.0005);
  EXPECT_LT(made::rotationError(align.getFinalTransformation(), pair.T_target_source),
            5);
  double largest = 0;
  for (std::size_t i = 0; i < aligned.size(); ++i) {
    const Eigen::Vector3d there =
        pair.T_target_source * (*pair.source)[i].getVector3fMap().cast<double>();
    largest =
        std::max(largest, (aligned[i].getVector3fMap().cast<double>() - there).norm());
  }
  EXPECT_LT(largest, 0.015);
  align.setCloudCheck(false);
  align.align(aligned);
  EXPECT_GT(made::rotationError(align.getFinalTransformation(), pair.T_target_source),
            5)
      << "the test needs a pair that correspondences alone get wrong";
  EXPECT_FLOAT_EQ(align.getMinSampleDistance(), 0.05f);
  EXPECT_TRUE(align.getErrorFunction());
}
