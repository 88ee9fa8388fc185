// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Correspondences that a program has already, and its guess.

#include "flash_registration_fixture.h"

using namespace pcl_flashreg;
using namespace pcl_flashreg::made;
using PointT = pcl::PointXYZ;

namespace {

/** \brief A hundred correspondences, of which the first 40 agree with the pose. */
class GivenCorrespondences : public testing::Test {
protected:
  static constexpr int size = 100, right = 40;

  GivenCorrespondences()
  {
    Random random(3);
    for (int i = 0; i < size; ++i) {
      const Eigen::Vector3d point = random.inCube(3);
      const Eigen::Vector3d other =
          i < right ? point : Eigen::Vector3d(random.inCube(3));
      source->push_back(RoomPairXYZ::toPoint<PointT>(point));
      target->push_back(RoomPairXYZ::toPoint<PointT>(roomPose() * other));
      correspondences->emplace_back(i, i, 0.0f);
    }
    registration.setInputSource(source);
    registration.setInputTarget(target);
    registration.setCorrespondences(correspondences);
    registration.setParameters(Parameters());
  }

  Cloud::Ptr source{new Cloud}, target{new Cloud};
  pcl::CorrespondencesPtr correspondences{new pcl::Correspondences};
  Registration registration;
  Cloud output;
};

/** \brief Right ones too close together for a clique, so that nothing but the guess can
 * explain them. */
class Guess : public GivenCorrespondences {
protected:
  Guess()
  {
    for (int i = 0; i < right; ++i) {
      auto& point = (*source)[i];
      point.getVector3fMap() = 0.01f * point.getVector3fMap();
      (*target)[i].getVector3fMap() =
          (roomPose() * point.getVector3fMap().cast<double>()).cast<float>();
    }
    Parameters parameters;
    parameters.refinement_iterations = 0;
    registration.setParameters(parameters);
  }
};

} // namespace

TEST_F(GivenCorrespondences, ReplaceFeatures)
{
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_LT((registration.getFinalTransformation() - roomPose().matrix().cast<float>())
                .norm(),
            1e-3);
  EXPECT_EQ(registration.getCorrespondences().size(), static_cast<std::size_t>(size));
  const auto inliers = registration.getInlierCorrespondences();
  ASSERT_GE(inliers.size(), static_cast<std::size_t>(right));
  for (int i = 0; i < right; ++i)
    EXPECT_EQ(inliers[i].index_query, i);
  EXPECT_FALSE(registration.getSourceFpfh().points);
}

TEST_F(GivenCorrespondences, KeepTheirNumbersWhereSomeAreIgnored)
{
  (*correspondences)[2].index_match = -1;
  spoil(*source, 4);
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (int i = 0; i < size; ++i)
    if (i % 5 != 0)
      indices->push_back(i);
  registration.setIndices(indices);
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  const Result& result = registration.getResult();
  EXPECT_EQ(result.correspondences_invalid, 22u);
  for (const int row : result.inliers)
    EXPECT_TRUE(row % 5 != 0 && row != 2 && row != 4) << row;
  EXPECT_GE(result.inliers.size(), 30u);
}

TEST_F(GivenCorrespondences, MustNamePointsOfTheClouds)
{
  const Silence silence;
  (*correspondences)[50].index_match = size;
  registration.align(output);
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_NE(registration.getErrorMessage().find("point 100 of a target"),
            std::string::npos);
  (*correspondences)[50].index_match = 50;
  (*correspondences)[51].index_query = -7;
  registration.align(output);
  EXPECT_FALSE(registration.hasConverged());
  (*correspondences)[51].index_query = 51;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  registration.setCorrespondences(pcl::CorrespondencesPtr(new pcl::Correspondences));
  registration.align(output);
  EXPECT_EQ(registration.getStatus(), Status::TooFewCorrespondences);
}

TEST_F(GivenCorrespondences, WithTheSmallestDistanceAreKept)
{
  Parameters parameters;
  parameters.max_correspondences = right;
  registration.setParameters(parameters);
  for (int i = 0; i < size; ++i)
    (*correspondences)[i].distance = i < right ? 1.0f : 2.0f;
  registration.align(output);
  EXPECT_EQ(registration.getResult().inliers.size(), static_cast<std::size_t>(right));
  EXPECT_EQ(registration.getResult().correspondences_dropped,
            static_cast<std::size_t>(size - right));
}

TEST(CorrespondencesOfClouds, AreJudgedByTheClouds)
{
  Registration registration;
  Cloud output;
  const FpfhCloud from = computeFpfh(*room().source, {}, room_resolution);
  const FpfhCloud to = computeFpfh(*room().target, {}, room_resolution);
  registration.setInputSource(room().source);
  registration.setInputTarget(room().target);
  // Few right ones among many: too few for a verdict of their own.
  const pcl::CorrespondencesPtr few(new pcl::Correspondences);
  const auto pose = roomPose();
  Random random(4);
  std::size_t right = 0;
  for (std::size_t i = 0; i < 500; ++i) {
    const auto s = static_cast<pcl::index_t>(random.next() % room().source->size());
    auto t = static_cast<pcl::index_t>(random.next() % room().target->size());
    if (right < 12) {
      const Eigen::Vector3d there =
          pose * (*room().source)[s].getVector3fMap().cast<double>();
      for (std::size_t j = 0; j < room().target->size(); ++j) {
        const Eigen::Vector3f point = (*room().target)[j].getVector3fMap();
        if ((point.cast<double>() - there).norm() < 0.02) {
          t = static_cast<pcl::index_t>(j);
          ++right;
          break;
        }
      }
    }
    few->emplace_back(s, t, 0.0f);
  }
  registration.setCorrespondences(few);
  registration.setResolution(room_resolution);
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged()) << registration.getConfidence();
  EXPECT_TRUE(registration.getResult().evidence.has_clouds);
  expectPose(registration.getFinalTransformation(), pose);

  registration.setCloudCheck(false);
  registration.align(output);
  EXPECT_FALSE(registration.hasConverged());
}

TEST_F(Guess, IsScoredAsOneMoreHypothesis)
{
  const Silence silence;
  const Eigen::Matrix4f truth = roomPose().matrix().cast<float>();
  registration.align(output);
  EXPECT_FALSE(registration.getFinalTransformation().isApprox(truth, 1e-3f));
  registration.align(output, truth);
  EXPECT_EQ(registration.getStatus(), Status::Ok);
  EXPECT_TRUE(registration.getFinalTransformation().isApprox(truth, 1e-5f));
  EXPECT_GE(registration.getInlierCorrespondences().size(),
            static_cast<std::size_t>(right));
  const Eigen::Vector3f moved = output[50].getVector3fMap();
  const Eigen::Vector4f expected = truth * (*source)[50].getVector4fMap();
  EXPECT_LT((moved - expected.head<3>()).norm(), 1e-4);
}

TEST_F(GivenCorrespondences, AreNotBoundByAWrongGuess)
{
  Eigen::Matrix4f wrong = Eigen::Matrix4f::Identity();
  wrong(0, 3) = 5;
  registration.align(output, wrong);
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_LT((registration.getFinalTransformation() - roomPose().matrix().cast<float>())
                .norm(),
            1e-3);
}

TEST_F(GivenCorrespondences, RefuseAGuessThatIsNotRigid)
{
  const Silence silence;
  Eigen::Matrix4f scaled = 2 * Eigen::Matrix4f::Identity();
  scaled(3, 3) = 1;
  Eigen::Matrix4f mirrored = Eigen::Matrix4f::Identity();
  mirrored(2, 2) = -1;
  Eigen::Matrix4f not_finite = Eigen::Matrix4f::Identity();
  not_finite(1, 3) = std::numeric_limits<float>::quiet_NaN();
  for (const auto& guess : {scaled, mirrored, not_finite}) {
    registration.align(output, guess);
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_NE(registration.getErrorMessage().find("guess"), std::string::npos);
  }
}
