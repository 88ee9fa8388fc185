// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Indices, points that are not finite, aliases, stale results, failures.

#include <cstring>
#include <numeric>

#include "flash_registration_fixture.h"

using namespace pcl_flashreg;
using namespace pcl_flashreg::made;

namespace {

bool
sameXYZ(const pcl::PointXYZ& a, const pcl::PointXYZ& b)
{
  return std::memcmp(a.data, b.data, 3 * sizeof(float)) == 0;
}

} // namespace

TEST_F(FlashRegistrationTest, HonoursIndices)
{
  // Every other point of the source is far from where it belongs.
  Cloud::Ptr mixed(new Cloud);
  mixed->sensor_origin_ = source->sensor_origin_;
  const pcl::IndicesPtr indices(new pcl::Indices);
  Random random(5);
  for (const auto& point : *source) {
    mixed->push_back(RoomPairXYZ::toPoint<pcl::PointXYZ>(random.inCube(5)));
    indices->push_back(static_cast<pcl::index_t>(mixed->size()));
    mixed->push_back(point);
  }
  registration.setInputSource(mixed);
  registration.setIndices(indices);
  registration.align(output);
  expectFound();
  ASSERT_EQ(output.size(), indices->size());
  EXPECT_LT(largestDifference(*source, output, registration.getResult()), 1e-5);
  ASSERT_FALSE(registration.getInliers().empty());
  for (const auto index : registration.getInliers())
    EXPECT_EQ(index % 2, 1);
  const std::size_t keypoints = registration.getSourceFpfh().points->size();
  EXPECT_EQ(keypoints, computeFpfh(*source, {}, room_resolution).points->size());

  // Other indices, other descriptors.
  indices->resize(indices->size() / 2);
  registration.align(output);
  EXPECT_EQ(output.size(), indices->size());
  EXPECT_LT(registration.getSourceFpfh().points->size(), 0.8 * keypoints);
}

TEST_F(FlashRegistrationTest, WithNoIndexFindsNothing)
{
  registration.setIndices(pcl::IndicesPtr(new pcl::Indices));
  alignSilently();
  expectNotFound("no source point");
  registration.setIndices(pcl::IndicesPtr());
  registration.align(output);
  expectFound();
}

TEST_F(FlashRegistrationTest, SkipsPointsThatAreNotFinite)
{
  for (std::size_t i = 0; i < 200; ++i) {
    spoil(*source, 7 * i);
    spoil(*target, 5 * i);
  }
  registration.align(output);
  expectFound();
  ASSERT_EQ(output.size(), source->size());
  EXPECT_TRUE(std::isnan(output[7].x));
  for (const auto index : registration.getInliers())
    EXPECT_TRUE(pcl::isFinite((*source)[index]));
  EXPECT_LT(registration.getFitnessScore(), 0.1);
}

TEST_F(FlashRegistrationTest, OfPointsThatAreNotFiniteFindsNothing)
{
  for (std::size_t i = 0; i < source->size(); ++i)
    spoil(*source, i);
  alignSilently();
  EXPECT_FALSE(registration.hasConverged());
  EXPECT_NE(registration.getErrorMessage(), "");
}

TEST_F(FlashRegistrationTest, OutputMayBeTheSource)
{
  const Cloud before = *source;
  registration.align(*source);
  expectFound();
  EXPECT_LT(largestDifference(before, *source, registration.getResult()), 1e-5);
  EXPECT_GT(registration.getInliers().size(), source->size() / 2);
  // The source is another one now, and so are its descriptors.
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectPose(registration.getFinalTransformation(), Eigen::Isometry3d::Identity());
}

TEST_F(FlashRegistrationTest, RefusesAnOutputThatOverwritesItsInput)
{
  const pcl::IndicesPtr indices(new pcl::Indices(source->size()));
  std::iota(indices->rbegin(), indices->rend(), 0);
  {
    const Silence silence;
    registration.setIndices(indices);
    registration.align(*source);
    expectNotFound("output is the input source");
    registration.setIndices(pcl::IndicesPtr());
    registration.align(*target);
    expectNotFound("output is the input target");
  }
  registration.setInputSource(room().source);
  registration.setInputTarget(room().target);
  registration.align(output);
  expectFound();
}

TEST_F(FlashRegistrationTest, ForgetsTheResultWithAnotherInput)
{
  const Silence silence;
  const Cloud::ConstPtr null, empty(new Cloud);
  const auto expectForgotten = [this] {
    expectNotFound("");
    EXPECT_TRUE(registration.getHypotheses().empty());
    EXPECT_TRUE(registration.getCorrespondences().empty());
    EXPECT_EQ(registration.getTimings().total, 0);
  };
  for (const auto& cloud : {Cloud::ConstPtr(source), empty, null}) {
    registration.align(output);
    expectFound();
    registration.setInputSource(cloud);
    expectForgotten();
    registration.align(output);
    expectFound();
    registration.setInputTarget(cloud == source ? target : cloud);
    expectForgotten();
  }
}

TEST_F(FlashRegistrationTest, WithoutInputDoesNotConverge)
{
  const Silence silence;
  Registration without_target, without_source;
  without_target.setInputSource(source);
  without_target.align(output);
  EXPECT_FALSE(without_target.hasConverged());
  without_source.setInputTarget(target);
  without_source.align(output);
  EXPECT_FALSE(without_source.hasConverged());
  EXPECT_TRUE(Registration().getInliers().empty());
}

TEST_F(FlashRegistrationTest, AfterAFailureIsStillUsable)
{
  const Cloud::Ptr two(new Cloud);
  two->push_back(pcl::PointXYZ(1, 2, 3));
  two->push_back(pcl::PointXYZ(3, 2, 1));
  registration.setInputSource(two);
  alignSilently();
  expectNotFound(toString(Status::TooFewCorrespondences));
  EXPECT_EQ(registration.getStatus(), Status::TooFewCorrespondences);
  ASSERT_EQ(output.size(), 2u);
  EXPECT_TRUE(sameXYZ(output[0], (*two)[0]) && sameXYZ(output[1], (*two)[1]));

  registration.setInputSource(source);
  registration.align(output);
  expectFound();
}

TEST_F(FlashRegistrationTest, ReportsSettingsThatMakeNoSense)
{
  const auto expectRefused = [this](const std::string& word) {
    alignSilently();
    expectNotFound(word);
    ASSERT_EQ(output.size(), source->size());
    EXPECT_TRUE(sameXYZ(output[5], (*source)[5]));
  };
  Parameters parameters = Parameters::fromResolution(room_resolution);
  parameters.length_tolerance = -1;
  registration.setParameters(parameters);
  expectRefused("length_tolerance");
  registration.setParameters(std::nullopt);
  for (const double resolution :
       {-0.1, std::numeric_limits<double>::infinity(), 1e-7}) {
    registration.setResolution(resolution);
    expectRefused("resolution");
  }
  registration.setResolution(room_resolution);
  registration.setCorrespondenceRandomness(0);
  expectRefused("randomness");
  registration.setCorrespondenceRandomness(1);
  registration.setInlierFraction(1.5f);
  expectRefused("inlier fraction");
  registration.setInlierFraction(0);
  registration.setMaxCorrespondenceDistance(0);
  expectRefused("inlier_distance");
  registration.setMaxCorrespondenceDistance(0.2);
  registration.align(output);
  expectFound();
}

TEST_F(FlashRegistrationTest, ReportsABackendThatCantBeHad)
{
  const auto backends = availableBackends();
  if (std::find(backends.begin(), backends.end(), "cuda") != backends.end())
    GTEST_SKIP() << "CUDA can be had on this machine";
  registration.setBackend(BackendKind::Cuda);
  alignSilently();
  expectNotFound("");
  EXPECT_NE(registration.getErrorMessage(), "");
  registration.setBackend(BackendKind::Cpu);
  registration.align(output);
  expectFound();
}

TEST_F(FlashRegistrationTest, TakesLargeCoordinates)
{
  const auto shift = [](Cloud& cloud, const Eigen::Vector3f& by) {
    for (auto& point : cloud)
      point.getVector3fMap() += by;
    cloud.sensor_origin_.head<3>() += by;
  };
  shift(*source, {4000, -3000, 100});
  shift(*target, {-2000, 5000, 50});
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  Eigen::Vector3d by(4000, -3000, 100);
  for (std::size_t i = 0; i < output.size(); i += 50) {
    const Eigen::Vector3d truth =
        room().T_target_source * (*room().source)[i].getVector3fMap().cast<double>() +
        Eigen::Vector3d(-2000, 5000, 50);
    EXPECT_LT((output[i].getVector3fMap().cast<double>() - truth).norm(), 0.08);
  }
  EXPECT_LT(largestDifference(*source, output, registration.getResult()), 1e-3);
}
