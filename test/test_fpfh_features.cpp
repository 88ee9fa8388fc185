// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/pcl_front_end.h>

#include <pcl/common/transforms.h>

#include <cstring>
#include <numeric>

#include "pcl_fixtures.h"

using namespace pcl_flashreg;
using Cloud = pcl::PointCloud<pcl::PointXYZ>;

namespace {

const Cloud&
room()
{
  static const Cloud cloud = *made::RoomPairXYZ().target;
  return cloud;
}

/** \brief Equal to the last bit. */
bool
same(const FpfhCloud& a, const FpfhCloud& b)
{
  if (a.points->size() != b.points->size() || a.features->size() != b.features->size())
    return false;
  for (std::size_t i = 0; i < a.points->size(); ++i)
    if (std::memcmp((*a.points)[i].data, (*b.points)[i].data, 3 * sizeof(float)) != 0 ||
        std::memcmp((*a.features)[i].histogram,
                    (*b.features)[i].histogram,
                    sizeof((*a.features)[i].histogram)) != 0)
      return false;
  return true;
}

} // namespace

TEST(ComputeFpfh, GivesOneFiniteDescriptorAKeypoint)
{
  FpfhTimings timings;
  const FpfhCloud result = computeFpfh(room(), {}, 0.1, 1, &timings);
  ASSERT_EQ(result.points->size(), result.features->size());
  EXPECT_GT(result.points->size(), 1000u);
  EXPECT_LT(result.points->size(), room().size() / 2);
  for (const auto& feature : *result.features) {
    // PCL scales each of the three histograms to 100.
    const float sum = std::accumulate(
        std::begin(feature.histogram), std::end(feature.histogram), 0.0f);
    ASSERT_NEAR(sum, 300, 0.1);
  }
  EXPECT_GT(timings.voxel_grid, 0);
  EXPECT_GT(timings.normals, 0);
  EXPECT_GT(timings.features, 0);
}

TEST(ComputeFpfh, DoesNotDependOnThreads)
{
  EXPECT_TRUE(same(computeFpfh(room(), {}, 0.1, 1), computeFpfh(room(), {}, 0.1, 3)));
}

TEST(ComputeFpfh, HonoursIndices)
{
  Cloud half;
  pcl::Indices indices;
  for (std::size_t i = 0; i < room().size(); i += 2) {
    indices.push_back(static_cast<pcl::index_t>(i));
    half.push_back(room()[i]);
  }
  half.sensor_origin_ = room().sensor_origin_;
  EXPECT_TRUE(
      same(computeFpfh(room(), indices, 0.1, 1), computeFpfh(half, {}, 0.1, 1)));
  EXPECT_FALSE(
      same(computeFpfh(room(), indices, 0.1, 1), computeFpfh(room(), {}, 0.1, 1)));
}

TEST(ComputeFpfh, RejectsIndicesOutOfRange)
{
  const auto size = static_cast<pcl::index_t>(room().size());
  EXPECT_THROW(computeFpfh(room(), {0, size}, 0.1), std::invalid_argument);
  EXPECT_THROW(computeFpfh(room(), {-1}, 0.1), std::invalid_argument);
}

TEST(ComputeFpfh, SkipsPointsThatAreNotFinite)
{
  Cloud spoiled = room();
  for (int i = 0; i < 50; ++i)
    spoiled.push_back(pcl::PointXYZ(0, i, std::numeric_limits<float>::infinity()));
  made::spoil(spoiled, room().size());
  EXPECT_TRUE(same(computeFpfh(spoiled, {}, 0.1, 1), computeFpfh(room(), {}, 0.1, 1)));
}

TEST(ComputeFpfh, LeavesOutVoxelsWithoutNeighbours)
{
  Cloud with_strays = room();
  for (int i = 0; i < 20; ++i)
    with_strays.push_back(pcl::PointXYZ(10 + i, 10, 10));
  const FpfhCloud result = computeFpfh(with_strays, {}, 0.1, 1);
  for (const auto& point : *result.points)
    EXPECT_LT(point.x, 9);
}

TEST(ComputeFpfh, OfTwoPointsIsEmpty)
{
  Cloud two;
  two.push_back(pcl::PointXYZ(0, 0, 0));
  two.push_back(pcl::PointXYZ(1, 0, 0));
  for (const Cloud& cloud : {Cloud(), two}) {
    const FpfhCloud result = computeFpfh(cloud, {}, 0.1);
    ASSERT_TRUE(result.points && result.features);
    EXPECT_EQ(result.points->size(), 0u);
    EXPECT_EQ(result.features->size(), 0u);
  }
}

TEST(ComputeFpfh, RejectsResolutionsThatMakeNoSense)
{
  for (const double resolution : {0.0,
                                  -0.1,
                                  std::numeric_limits<double>::quiet_NaN(),
                                  std::numeric_limits<double>::infinity()})
    EXPECT_THROW(computeFpfh(room(), {}, resolution), std::invalid_argument);
}

TEST(ComputeFpfh, WithPclRejectsResolutionsTooSmallForTheExtent)
{
  const auto compute = [](const Cloud& cloud, double resolution) {
    computeFpfhWithPcl(cloud, {}, resolution);
  };
  // 3 m x 2.4 m x 2 m in voxels of 1 mm are 1.4e10 of them.
  EXPECT_THROW(compute(room(), 0.001), std::invalid_argument);
  // Few voxels, but at numbers beyond 2^31.
  Cloud far;
  for (int i = 0; i < 10; ++i)
    far.push_back(pcl::PointXYZ(3e9f, 1, 1));
  EXPECT_THROW(compute(far, 0.5), std::invalid_argument);
}

TEST(EstimateResolution, FindsTheVoxelSizeThatTheDensityAllows)
{
  // 350 points a square metre: a quarter as many voxels are 11 cm wide.
  EXPECT_NEAR(estimateResolution(room()), 0.1, 0.03);
}

TEST(EstimateResolution, ScalesWithTheCloud)
{
  const double expected = estimateResolution(room());
  for (const float scale : {0.001f, 0.1f, 10.0f, 1000.0f}) {
    Cloud scaled;
    pcl::transformPointCloud(room(), scaled, Eigen::Affine3f(Eigen::Scaling(scale)));
    EXPECT_NEAR(estimateResolution(scaled) / (scale * expected), 1, 1e-6);
  }
}

TEST(EstimateResolution, IsAPreferredNumber)
{
  const double resolution = estimateResolution(room());
  const double digits = resolution / std::pow(10, std::floor(std::log10(resolution)));
  const std::vector<double> steps{1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8};
  EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), [&](double step) {
    return std::abs(digits - step) < 1e-9;
  })) << resolution;
}

TEST(EstimateResolution, IgnoresStraysAndPointsThatAreNotFinite)
{
  Cloud spoiled = room();
  for (int i = 0; i < 5; ++i)
    spoiled.push_back(pcl::PointXYZ(1e6f * static_cast<float>(i), -1e7f, 1e30f));
  spoiled.push_back(room()[0]);
  made::spoil(spoiled, spoiled.size() - 1);
  EXPECT_EQ(estimateResolution(spoiled), estimateResolution(room()));
}

TEST(EstimateResolution, NeedsTwoDistinctPoints)
{
  Cloud cloud;
  EXPECT_THROW(estimateResolution(cloud), std::invalid_argument);
  cloud.resize(100, pcl::PointXYZ(1, 2, 3));
  EXPECT_THROW(estimateResolution(cloud), std::invalid_argument);
  cloud.clear();
  cloud.push_back(pcl::PointXYZ(1, 2, 3));
  cloud.push_back(pcl::PointXYZ(1, 2, 4));
  EXPECT_GT(estimateResolution(cloud), 0);
}

TEST(EstimateVoxelSize, FindsWhatACloudWasDownsampledWith)
{
  const Cloud dense = *made::RoomPairXYZ(4000).target;
  for (const double voxel : {0.06, 0.1, 0.15}) {
    Cloud turned;
    const auto downsampled = detail::downsample(dense.makeShared(), voxel);
    pcl::transformPointCloud(
        *downsampled, turned, made::roomPose().cast<float>().matrix());
    EXPECT_NEAR(estimateVoxelSize(turned) / voxel, 1, 0.25);
  }
}
