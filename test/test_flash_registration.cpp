// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What FlashRegistration finds and tells, and what it can be told.

#include "flash_registration_fixture.h"

using namespace pcl_flashreg;
using namespace pcl_flashreg::made;

TEST_F(FlashRegistrationTest, FindsThePose)
{
  registration.align(output);
  expectFound();
  ASSERT_EQ(output.size(), source->size());
  EXPECT_LT(largestDifference(*source, output, registration.getResult()), 1e-5);
  EXPECT_TRUE(registration.getLastIncrementalTransformation() ==
              registration.getFinalTransformation());
}

TEST_F(FlashRegistrationTest, TellsWhatSpeaksForThePose)
{
  registration.align(output);
  const Result& result = registration.getResult();
  ASSERT_FALSE(result.inliers.empty());
  EXPECT_EQ(registration.getInlierCorrespondences().size(), result.inliers.size());
  EXPECT_GT(registration.getCorrespondences().size(), result.inliers.size());
  ASSERT_FALSE(registration.getHypotheses().empty());
  EXPECT_GT(registration.getInformationMatrix().trace(), 0);
  EXPECT_FALSE(result.backend.empty());

  const auto pose = result.T_target_source.toIsometry();
  for (const auto& inlier : registration.getInlierCorrespondences()) {
    const auto& a = (*registration.getSourceFpfh().points)[inlier.index_query];
    const auto& b = (*registration.getTargetFpfh().points)[inlier.index_match];
    EXPECT_LT(
        (pose * a.getVector3fMap().cast<double>() - b.getVector3fMap().cast<double>())
            .norm(),
        registration.getParameters().inlier_distance + 1e-5);
  }
}

TEST_F(FlashRegistrationTest, LetsTheCloudsHaveASay)
{
  EXPECT_TRUE(registration.getCloudCheck());
  EXPECT_TRUE(registration.getViewpointsKnown());
  registration.align(output);
  expectFound();
  EXPECT_TRUE(registration.getResult().evidence.has_clouds);
  EXPECT_GT(registration.getResult().evidence.agreement.matched, 0.3);
  EXPECT_GE(registration.getConfidence(), registration.getParameters().min_confidence);
  EXPECT_LE(registration.getConfidence(), 1);

  registration.setViewpointsKnown(false);
  registration.align(output);
  expectFound();
  EXPECT_FALSE(registration.getResult().evidence.has_viewpoints);
  EXPECT_TRUE(registration.getResult().evidence.has_sides);

  registration.setCloudCheck(false);
  registration.align(output);
  expectFound();
  EXPECT_FALSE(registration.getResult().evidence.has_clouds);
}

TEST_F(FlashRegistrationTest, LooksASecondTimeUnlessToldNotTo)
{
  Parameters parameters = registration.getParameters();
  parameters.min_confidence = 1;
  registration.setParameters(parameters);
  EXPECT_TRUE(registration.getSecondLook());
  registration.align(output);
  EXPECT_GT(registration.getResult().timings_ms.second_look, 0);
  registration.setSecondLook(false);
  registration.align(output);
  EXPECT_EQ(registration.getResult().timings_ms.second_look, 0);
}

TEST_F(FlashRegistrationTest, EstimatesTheResolution)
{
  registration.setResolution(0);
  EXPECT_EQ(registration.getResolution(), 0);
  registration.align(output);
  expectFound();
  EXPECT_EQ(registration.getResolution(),
            std::max(estimateResolution(*source), estimateResolution(*target)));
  EXPECT_NEAR(registration.getParameters().inlier_distance,
              2 * registration.getResolution(),
              1e-6);
}

TEST_F(FlashRegistrationTest, GivesTheSameBitsEveryTime)
{
  registration.align(output);
  const Eigen::Matrix4f first = registration.getFinalTransformation();
  for (const unsigned num_threads : {1u, 2u, 3u}) {
    Registration other;
    other.setNumberOfThreads(num_threads);
    other.setResolution(room_resolution);
    other.setInputSource(source);
    other.setInputTarget(target);
    other.align(output);
    EXPECT_TRUE(first == other.getFinalTransformation());
  }
}

TEST_F(FlashRegistrationTest, WorksThroughTheBaseClass)
{
  const pcl::Registration<pcl::PointXYZ, pcl::PointXYZ>::Ptr base(new Registration);
  base->setInputSource(source);
  base->setInputTarget(target);
  base->align(output);
  EXPECT_TRUE(base->hasConverged());
  EXPECT_EQ(base->getClassName(), "FlashRegistration");
  expectPose(base->getFinalTransformation(), room().T_target_source);
  EXPECT_LT(base->getFitnessScore(0.05 * 0.05), 0.05 * 0.05);
}

TEST_F(FlashRegistrationTest, CopiesWorkOnTheirOwn)
{
  registration.align(output);
  Registration copy = registration;
  EXPECT_TRUE(copy.hasConverged());
  copy.setInputSource(target);
  EXPECT_FALSE(copy.hasConverged());
  copy.align(output);
  EXPECT_TRUE(copy.hasConverged());
  EXPECT_TRUE(copy.getFinalTransformation().isIdentity(0.1f * room_resolution));
  expectFound();
  EXPECT_FALSE(registration.getInlierCorrespondences().empty());
}

TEST_F(FlashRegistrationTest, BuildsTheTargetTreeOnlyWhenItIsSearched)
{
  using Tree = LazyKdTree<pcl::PointXYZ>;
  registration.align(output);
  const auto tree =
      std::dynamic_pointer_cast<Tree>(registration.getSearchMethodTarget());
  ASSERT_TRUE(tree);
  EXPECT_FALSE(tree->isBuilt());
  // Parts that do not overlap: at most 2.5 m away, a mean of far less.
  EXPECT_LT(registration.getFitnessScore(), 0.1);
  EXPECT_TRUE(tree->isBuilt());
}

TEST_F(FlashRegistrationTest, RespectsATreeOfTheUsers)
{
  using Tree = pcl::search::KdTree<pcl::PointXYZ>;
  const Tree::Ptr tree(new Tree);
  tree->setInputCloud(target);
  registration.setSearchMethodTarget(tree, true);
  registration.align(output);
  const std::size_t inliers = registration.getInliers().size();
  EXPECT_EQ(registration.getSearchMethodTarget(), tree);

  Registration with_own_tree;
  with_own_tree.setResolution(room_resolution);
  with_own_tree.setInputSource(source);
  with_own_tree.setInputTarget(target);
  with_own_tree.align(output);
  EXPECT_EQ(with_own_tree.getInliers().size(), inliers);
  // A tree that is set after the computation gets the target before it is searched.
  with_own_tree.align(output);
  with_own_tree.setSearchMethodTarget(Tree::Ptr(new Tree));
  EXPECT_EQ(with_own_tree.getInliers().size(), inliers);
}

TEST_F(FlashRegistrationTest, InliersAreSourcePointsNearTheTarget)
{
  registration.setMaxCorrespondenceDistance(0.15);
  registration.align(output);
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(target);
  pcl::Indices expected, neighbor(1);
  std::vector<float> squared_distance(1);
  for (std::size_t i = 0; i < output.size(); ++i)
    if (tree.nearestKSearch(output[i], 1, neighbor, squared_distance) > 0 &&
        squared_distance[0] < 0.15 * 0.15)
      expected.push_back(static_cast<pcl::index_t>(i));
  EXPECT_EQ(registration.getInliers(), expected);
  EXPECT_GT(expected.size(), source->size() / 2);
  EXPECT_LT(expected.size(), source->size());
}

/** \brief Beams without a return, stored as zeros: more of them than there are others. */
TEST_F(FlashRegistrationTest, InliersAmongEqualPointsAreSearchedForOnce)
{
  /** \brief Counts what it is asked for. */
  struct CountingTree : LazyKdTree<pcl::PointXYZ> {
    using LazyKdTree<pcl::PointXYZ>::nearestKSearch;

    int
    nearestKSearch(const pcl::PointXYZ& point,
                   int k,
                   pcl::Indices& indices,
                   std::vector<float>& squared_distances) const override
    {
      ++searches;
      return LazyKdTree::nearestKSearch(point, k, indices, squared_distances);
    }

    mutable std::size_t searches = 0;
  };
  registration.align(output);
  const pcl::Indices plain = registration.getInliers();
  const std::size_t size = source->size();
  source->insert(source->end(), 2 * size, pcl::PointXYZ(0, 0, 0));
  target->insert(target->end(), 2 * size, pcl::PointXYZ(0, 0, 0));
  const auto tree = pcl::make_shared<CountingTree>();
  registration.setSearchMethodTarget(tree);
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.align(output);
  expectFound();
  const pcl::Indices& inliers = registration.getInliers();
  EXPECT_EQ(tree->searches, size + 1);
  // The sensor of the source is far from what the target holds.
  pcl::Indices of_others;
  std::copy_if(inliers.begin(),
               inliers.end(),
               std::back_inserter(of_others),
               [&](auto i) { return static_cast<std::size_t>(i) < size; });
  EXPECT_NEAR(static_cast<double>(of_others.size()),
              static_cast<double>(plain.size()),
              0.02 * static_cast<double>(plain.size()));
  EXPECT_EQ(inliers, of_others);
  // And where the zeros meet.
  Cloud::Ptr itself(new Cloud(*target));
  registration.setInputSource(itself);
  registration.align(output);
  EXPECT_EQ(registration.getInliers().size(), itself->size());
}

TEST_F(FlashRegistrationTest, InlierFractionIsOneMoreCondition)
{
  registration.setInlierFraction(0.5f);
  registration.align(output);
  expectFound();
  registration.setInlierFraction(1.0f);
  registration.align(output);
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_TRUE(registration.getResult().converged);
  expectPose(registration.getFinalTransformation(), room().T_target_source);
}

TEST_F(FlashRegistrationTest, ExplicitParametersWinOverTheResolution)
{
  EXPECT_FLOAT_EQ(registration.getParameters().inlier_distance, 0.2f);
  EXPECT_FLOAT_EQ(registration.getParameters().length_tolerance, 0.024f);
  registration.setParameters(Parameters::fromResolution(0.2));
  EXPECT_FLOAT_EQ(registration.getParameters().inlier_distance, 0.4f);
  registration.setMaxCorrespondenceDistance(0.3);
  EXPECT_FLOAT_EQ(registration.getParameters().inlier_distance, 0.3f);
  EXPECT_FLOAT_EQ(registration.getParameters().length_tolerance, 0.048f);
}

TEST_F(FlashRegistrationTest, KnowsWhichWayIsUp)
{
  const Eigen::Vector3d up(0, 0, 2);
  const Eigen::Vector3d up_in_source = room().T_target_source.linear().transpose() * up;
  registration.setMotion(MotionModel::Upright);
  registration.setMaxTilt(2);
  registration.setGravity(up_in_source, up);
  registration.align(output);
  expectFound();
  EXPECT_EQ(registration.getResult().evidence.tilted, 0);

  const Eigen::Vector3d off =
      Eigen::AngleAxisd(20 * M_PI / 180, Eigen::Vector3d(1, 2, 0).normalized()) * up;
  registration.setGravity(up_in_source, off);
  registration.align(output);
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_GT(registration.getResult().evidence.tilted, 1);

  registration.setMotion(MotionModel::Rigid);
  registration.align(output);
  expectFound();

  registration.setMotion(MotionModel::Upright);
  registration.setGravity(Eigen::Vector3d::Zero(), up);
  alignSilently();
  expectNotFound("source_gravity");
  registration.setGravity(up_in_source, up);
  registration.setMaxTilt(0);
  alignSilently();
  expectNotFound("max_tilt");
}

TEST_F(FlashRegistrationTest, WhatIsSaidOfTheMotionWinsOverTheParameters)
{
  Parameters parameters;
  parameters.motion = MotionModel::Upright;
  parameters.max_tilt = 7;
  parameters.source_gravity = {0, 1, 0};
  registration.setParameters(parameters);
  EXPECT_EQ(registration.getParameters().motion, MotionModel::Upright);
  EXPECT_EQ(registration.getParameters().max_tilt, 7);
  EXPECT_EQ(registration.getParameters().source_gravity[1], 1);
  registration.setMaxTilt(5);
  registration.setGravity({1, 0, 0}, {0, 1, 0});
  EXPECT_EQ(registration.getParameters().max_tilt, 5);
  EXPECT_EQ(registration.getParameters().source_gravity[0], 1);
  EXPECT_EQ(registration.getParameters().target_gravity[1], 1);
  registration.setMotion(MotionModel::Rigid);
  EXPECT_EQ(registration.getParameters().motion, MotionModel::Rigid);
  registration.setParameters(std::nullopt);
  EXPECT_EQ(registration.getParameters().max_tilt, 5);
}

TEST_F(FlashRegistrationTest, MeasuresWhatItDoes)
{
  registration.align(output);
  const FlashRegistrationTimings timings = registration.getTimings();
  EXPECT_GT(timings.source_features.features, 0);
  EXPECT_GT(timings.target_features.features, 0);
  EXPECT_GT(timings.matching, 0);
  EXPECT_GT(timings.estimation.total, 0);
  EXPECT_GE(timings.total, timings.matching + timings.estimation.total);
}
