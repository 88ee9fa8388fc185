// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Descriptors, given and computed, as the source of correspondences.

#include <pcl/common/io.h>
#include <pcl/features/shot.h>

#include <set>

#include "flash_registration_fixture.h"

using namespace pcl_flashreg;
using namespace pcl_flashreg::made;
using PointT = pcl::PointXYZ;
using Fpfh = pcl::PointCloud<pcl::FPFHSignature33>;

namespace {

/** \brief Descriptors of the room, and a program's own copies of them. */
class GivenFeatures : public testing::Test {
protected:
  GivenFeatures()
  {
    static const FpfhCloud source_fpfh =
        computeFpfh(*room().source, {}, room_resolution);
    static const FpfhCloud target_fpfh =
        computeFpfh(*room().target, {}, room_resolution);
    source.reset(new Cloud(*source_fpfh.points));
    target.reset(new Cloud(*target_fpfh.points));
    source_features.reset(new Fpfh(*source_fpfh.features));
    target_features.reset(new Fpfh(*target_fpfh.features));
    registration.setInputSource(source);
    registration.setInputTarget(target);
    registration.setSourceFeatures(source_features);
    registration.setTargetFeatures(target_features);
  }

  void
  expectFound()
  {
    EXPECT_TRUE(registration.hasConverged()) << registration.getErrorMessage();
    expectPose(registration.getFinalTransformation(), room().T_target_source);
  }

  void
  expectRefused(const std::string& word)
  {
    const Silence silence;
    registration.align(output);
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_TRUE(registration.getFinalTransformation().isIdentity(0));
    EXPECT_NE(registration.getErrorMessage().find(word), std::string::npos)
        << registration.getErrorMessage();
    EXPECT_EQ(output.size(), source->size());
  }

  Cloud::Ptr source, target;
  Fpfh::Ptr source_features, target_features;
  Registration registration;
  Cloud output;
};

} // namespace

TEST_F(GivenFeatures, AreMatched)
{
  registration.setResolution(room_resolution);
  registration.align(output);
  expectFound();
  EXPECT_EQ(registration.getCorrespondences().size(), source->size());
  EXPECT_FALSE(registration.getSourceFpfh().points);
  for (const auto& inlier : registration.getInlierCorrespondences()) {
    const Eigen::Vector3d moved =
        registration.getResult().T_target_source.toIsometry() *
        (*source)[inlier.index_query].getVector3fMap().cast<double>();
    const auto there = (*target)[inlier.index_match].getVector3fMap().cast<double>();
    EXPECT_LT((moved - there).norm(), 2 * room_resolution + 1e-5);
  }
}

TEST_F(GivenFeatures, AreJudgedByTheClouds)
{
  registration.setResolution(room_resolution);
  registration.align(output);
  expectFound();
  const Evidence asked = registration.getResult().evidence;
  EXPECT_TRUE(asked.has_clouds);
  EXPECT_TRUE(asked.has_viewpoints);
  EXPECT_GT(asked.agreement.matched, 0.5);

  registration.setCloudCheck(false);
  registration.align(output);
  EXPECT_FALSE(registration.getResult().evidence.has_clouds);
}

/** \brief Descriptors of the room by PCL's SHOT. */
pcl::PointCloud<pcl::SHOT352>::Ptr
shotOf(const FpfhCloud& keypoints)
{
  pcl::PointCloud<pcl::SHOT352>::Ptr features(new pcl::PointCloud<pcl::SHOT352>);
  pcl::SHOTEstimation<PointT, pcl::Normal, pcl::SHOT352> estimation;
  estimation.setRadiusSearch(5 * room_resolution);
  estimation.setInputCloud(keypoints.points);
  estimation.setInputNormals(keypoints.normals);
  estimation.compute(*features);
  return features;
}

/** \brief As a network's: 32 numbers without a meaning. */
pcl::PointCloud<pcl::Histogram<32>>::Ptr
first32Of(const FpfhCloud& keypoints)
{
  pcl::PointCloud<pcl::Histogram<32>>::Ptr features(
      new pcl::PointCloud<pcl::Histogram<32>>);
  features->resize(keypoints.features->size());
  for (std::size_t i = 0; i < features->size(); ++i)
    std::copy_n((*keypoints.features)[i].histogram, 32, (*features)[i].histogram);
  return features;
}

template <typename FeatureT>
void
expectJudged(const typename pcl::PointCloud<FeatureT>::Ptr& source_features,
             const typename pcl::PointCloud<FeatureT>::Ptr& target_features,
             const Cloud::Ptr& source,
             const Cloud::Ptr& target)
{
  FlashRegistration<PointT, PointT, FeatureT> registration;
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setSourceFeatures(source_features);
  registration.setTargetFeatures(target_features);
  registration.setResolution(room_resolution);
  Cloud output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged()) << registration.getErrorMessage();
  expectPose(registration.getFinalTransformation(), room().T_target_source);
  EXPECT_TRUE(registration.getResult().evidence.has_clouds);
  EXPECT_GT(registration.getResult().evidence.agreement.matched, 0.5);
}

TEST_F(GivenFeatures, AreJudgedWhateverTheirType)
{
  const FpfhCloud from = computeFpfh(*room().source, {}, room_resolution);
  const FpfhCloud to = computeFpfh(*room().target, {}, room_resolution);
  expectJudged<pcl::SHOT352>(shotOf(from), shotOf(to), source, target);
  expectJudged<pcl::Histogram<32>>(first32Of(from), first32Of(to), source, target);
}

TEST_F(GivenFeatures, ComeWithNormalsWhereThePointsHaveThem)
{
  using PointNormal = pcl::PointNormal;
  FlashRegistration<PointNormal, PointNormal> other;
  const auto with_normals = [](const Cloud& points, const FpfhCloud& fpfh) {
    pcl::PointCloud<PointNormal>::Ptr cloud(new pcl::PointCloud<PointNormal>);
    pcl::concatenateFields(points, *fpfh.normals, *cloud);
    cloud->sensor_origin_ = points.sensor_origin_;
    return cloud;
  };
  const FpfhCloud from = computeFpfh(*room().source, {}, room_resolution);
  const FpfhCloud to = computeFpfh(*room().target, {}, room_resolution);
  const auto source_points = with_normals(*source, from);
  const auto target_points = with_normals(*target, to);
  other.setInputSource(source_points);
  other.setInputTarget(target_points);
  other.setSourceFeatures(source_features);
  other.setTargetFeatures(target_features);
  other.setResolution(room_resolution);
  pcl::PointCloud<PointNormal> aligned;
  other.align(aligned);
  EXPECT_TRUE(other.hasConverged());
  const double matched = other.getResult().evidence.agreement.matched;
  EXPECT_GT(matched, 0.5);

  // Normals that lie in the surfaces match nowhere; those that nobody has set are computed.
  for (auto& point : *source_points)
    point.getNormalVector3fMap() = point.getNormalVector3fMap().unitOrthogonal().eval();
  other.align(aligned);
  EXPECT_LT(other.getResult().evidence.agreement.matched, 0.5 * matched);
  for (auto& point : *source_points)
    point.getNormalVector3fMap().setZero();
  other.align(aligned);
  EXPECT_GT(other.getResult().evidence.agreement.matched, 0.9 * matched);
}

TEST_F(GivenFeatures, TakeTheResolutionFromTheSpacing)
{
  registration.align(output);
  expectFound();
  EXPECT_NEAR(registration.getResolution(), room_resolution, 0.03);
}

TEST_F(GivenFeatures, MustBeOneAPointOnBothSides)
{
  source_features->resize(source_features->size() - 1);
  expectRefused("source features for");
  source_features->push_back(source_features->back());
  target_features->resize(target_features->size() - 1);
  expectRefused("target features for");
  registration.clearFeatures();
  registration.setSourceFeatures(source_features);
  expectRefused("no target features");
  {
    const Silence silence;
    registration.setSourceFeatures(Fpfh::ConstPtr());
    registration.setSourceFeatures(Fpfh::Ptr(new Fpfh));
    registration.setTargetFeatures(Fpfh::ConstPtr());
  }
  EXPECT_EQ(registration.getSourceFeatures(), source_features);
  EXPECT_FALSE(registration.getTargetFeatures());
}

TEST_F(GivenFeatures, AreSkippedWhereTheyOrTheirPointsAreNotFinite)
{
  std::set<pcl::index_t> bad_source, bad_target;
  for (int i = 0; i < 100; ++i) {
    spoil(*source, 10 * i);
    spoil(*target, 10 * i + 1);
    (*source_features)[10 * i + 2].histogram[i % 33] =
        std::numeric_limits<float>::quiet_NaN();
    (*target_features)[10 * i + 3].histogram[i % 33] =
        std::numeric_limits<float>::infinity();
    bad_source.insert({10 * i, 10 * i + 2});
    bad_target.insert({10 * i + 1, 10 * i + 3});
  }
  registration.setResolution(room_resolution);
  registration.align(output);
  expectFound();
  EXPECT_EQ(registration.getCorrespondences().size(),
            source->size() - bad_source.size());
  for (const auto& correspondence : registration.getCorrespondences()) {
    EXPECT_EQ(bad_source.count(correspondence.index_query), 0u);
    EXPECT_EQ(bad_target.count(correspondence.index_match), 0u);
  }
}

TEST_F(GivenFeatures, AreThoseOfTheSelectedPoints)
{
  const pcl::IndicesPtr indices(new pcl::Indices);
  for (std::size_t i = 1; i < source->size(); i += 2)
    indices->push_back(static_cast<pcl::index_t>(i));
  registration.setIndices(indices);
  registration.setResolution(room_resolution);
  registration.align(output);
  expectFound();
  EXPECT_EQ(output.size(), indices->size());
  ASSERT_EQ(registration.getCorrespondences().size(), indices->size());
  for (std::size_t i = 0; i < indices->size(); ++i)
    EXPECT_EQ(registration.getCorrespondences()[i].index_query, (*indices)[i]);
}

TEST_F(GivenFeatures, CanBeMatchedWithSeveral)
{
  registration.setResolution(room_resolution);
  registration.setCorrespondenceRandomness(3);
  registration.align(output);
  expectFound();
  EXPECT_EQ(registration.getCorrespondences().size(), 3 * source->size());
  EXPECT_LE(registration.getCorrespondences()[0].distance,
            registration.getCorrespondences()[1].distance);
}

TEST_F(GivenFeatures, GiveWayToComputedOnes)
{
  registration.clearFeatures();
  registration.setInputSource(room().source);
  registration.setInputTarget(room().target);
  registration.setResolution(room_resolution);
  registration.align(output);
  expectFound();
  EXPECT_EQ(registration.getSourceFpfh().points->size(), source->size());
}

TEST_F(GivenFeatures, MayBeOfAnyTypeThatIsAnArrayOfFloats)
{
  using Histogram = pcl::Histogram<33>;
  FlashRegistration<PointT, PointT, Histogram> other;
  pcl::PointCloud<Histogram>::Ptr a(new pcl::PointCloud<Histogram>);
  pcl::PointCloud<Histogram>::Ptr b(new pcl::PointCloud<Histogram>);
  const auto copy = [](const Fpfh& from, pcl::PointCloud<Histogram>& to) {
    to.resize(from.size());
    for (std::size_t i = 0; i < from.size(); ++i)
      std::copy_n(from[i].histogram, 33, to[i].histogram);
  };
  copy(*source_features, *a);
  copy(*target_features, *b);
  other.setInputSource(source);
  other.setInputTarget(target);
  other.setSourceFeatures(a);
  other.setTargetFeatures(b);
  other.align(output);
  registration.align(output);
  EXPECT_TRUE(other.hasConverged());
  EXPECT_TRUE(other.getFinalTransformation() == registration.getFinalTransformation());

  // A representation of the caller's: nothing but the first of the three histograms.
  using FirstOnly = pcl::CustomPointRepresentation<Histogram>;
  other.setFeatureRepresentation(FirstOnly::Ptr(new FirstOnly(11)));
  const float all = other.getCorrespondences()[0].distance;
  other.align(output);
  EXPECT_LT(other.getCorrespondences()[0].distance, all);
}

TEST(ComputedFeatures, StayWhereTheResolutionIsEstimatedAgain)
{
  Registration registration;
  Cloud output;
  registration.setInputTarget(room().target);
  registration.setInputSource(room().source);
  registration.align(output);
  const double resolution = registration.getResolution();
  EXPECT_GT(resolution, 0);
  const auto source_points = registration.getSourceFpfh().points;
  registration.align(output);
  EXPECT_EQ(registration.getResolution(), resolution);
  EXPECT_EQ(registration.getSourceFpfh().points, source_points);

  const Cloud::Ptr half(new Cloud);
  for (const auto& point : *room().source)
    half->push_back(
        RoomPairXYZ::toPoint<PointT>(0.5 * point.getVector3fMap().cast<double>()));
  const Cloud::Ptr half_target(new Cloud);
  for (const auto& point : *room().target)
    half_target->push_back(
        RoomPairXYZ::toPoint<PointT>(0.5 * point.getVector3fMap().cast<double>()));
  registration.setInputSource(half);
  registration.setInputTarget(half_target);
  registration.align(output);
  EXPECT_LT(registration.getResolution(), 0.7 * resolution)
      << "another pair, another one";
}

TEST(ComputedFeatures, OfATargetThatStaysAreComputedOnce)
{
  const RoomPairXYZ other(400, 7);
  Registration registration;
  Cloud output;
  registration.setResolution(room_resolution);
  registration.setInputTarget(room().target);
  registration.setInputSource(room().source);
  registration.align(output);
  const auto target_points = registration.getTargetFpfh().points;
  const auto source_points = registration.getSourceFpfh().points;
  EXPECT_GT(registration.getTimings().target_features.features, 0);

  registration.align(output);
  EXPECT_EQ(registration.getSourceFpfh().points, source_points);
  EXPECT_EQ(registration.getTimings().source_features.features, 0);

  registration.setInputSource(other.source);
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  expectPose(registration.getFinalTransformation(), other.T_target_source);
  EXPECT_EQ(registration.getTargetFpfh().points, target_points);
  EXPECT_EQ(registration.getTimings().target_features.features, 0);
  EXPECT_GT(registration.getTimings().source_features.features, 0);

  registration.setInputTarget(room().target);
  registration.align(output);
  EXPECT_NE(registration.getTargetFpfh().points, target_points);

  registration.setResolution(0.12);
  registration.align(output);
  EXPECT_LT(registration.getTargetFpfh().points->size(), target_points->size());
}
