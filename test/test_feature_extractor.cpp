// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "simd/kernels.h"
#include "support/point_rows.h"

#include <pcl_flashreg/feature_extractor.h>

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <numeric>

namespace pcl_flashreg {
namespace {

using made::Points;
using made::viewOf;

DescribedCloud
describe(const Points& points, double resolution, unsigned threads = 1)
{
  return FeatureExtractor(threads).describe(
      viewOf(points), FeatureParameters::fromResolution(resolution));
}

void
expectSame(const DescribedCloud& a, const DescribedCloud& b)
{
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.curvatures, b.curvatures);
  EXPECT_EQ(a.descriptors, b.descriptors);
}

/** \brief Centroids by voxel coordinates, in a plain map. */
std::map<std::array<double, 3>, Eigen::Vector3d>
voxelOracle(const Points& points, float size)
{
  std::map<std::array<double, 3>, std::pair<Eigen::Vector3d, int>> sums;
  const float inverse = 1 / size;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const Eigen::Vector3f p(&points[i]);
    auto& [sum, count] = sums.try_emplace({std::floor(p.z() * inverse),
                                           std::floor(p.y() * inverse),
                                           std::floor(p.x() * inverse)},
                                          std::make_pair(Eigen::Vector3d(0, 0, 0), 0))
                             .first->second;
    sum += p.cast<double>();
    ++count;
  }
  std::map<std::array<double, 3>, Eigen::Vector3d> centroids;
  for (const auto& [voxel, sum] : sums)
    centroids[voxel] = sum.first / sum.second;
  return centroids;
}

/** \brief All three radii so large that every point is described. */
FeatureParameters
withVoxel(double size, double reach)
{
  FeatureParameters parameters;
  parameters.voxel_size = size;
  parameters.normal_radius = reach;
  parameters.feature_radius = reach;
  return parameters;
}

} // namespace

class EveryVariant : public testing::Test {
protected:
  /** \brief Calls run() with each SIMD variant of this machine selected. */
  template <typename Run>
  static void
  forEachVariant(const Run& run)
  {
    std::size_t count = 0;
    const cpu::Kernels* const* kernels = cpu::availableKernels(count);
    for (std::size_t i = 0; i < count; ++i) {
      SCOPED_TRACE(kernels[i]->name);
      setenv("PCL_FLASHREG_CPU", kernels[i]->name, 1);
      run();
      unsetenv("PCL_FLASHREG_CPU");
    }
  }
};

TEST_F(EveryVariant, AndNumberOfThreadsGivesTheSameBits)
{
  const Points points = made::roomPoints(3000); // more than one piece of the voxel grid
  const DescribedCloud reference = describe(points, 0.05);
  EXPECT_GT(reference.size, 5000u);
  forEachVariant([&] {
    for (const unsigned threads : {1u, 2u, 3u})
      expectSame(describe(points, 0.05, threads), reference);
  });
}

TEST_F(EveryVariant, OfASecondCallGivesTheSameBits)
{
  FeatureExtractor extractor(2);
  const Points large = made::roomPoints(800), small = made::roomPoints(100);
  const auto run = [&extractor](const Points& points) {
    return extractor.describe(viewOf(points), FeatureParameters::fromResolution(0.1));
  };
  const DescribedCloud first = run(large);
  run(small);
  expectSame(run(large), first);
}

TEST(VoxelGrid, KeepsTheCentroidOfEachVoxelInOrder)
{
  const Points points = made::roomPoints(1000);
  const auto expected = voxelOracle(points, 0.1f);
  const DescribedCloud result =
      FeatureExtractor(2).describe(viewOf(points), withVoxel(0.1, 1.0));
  ASSERT_EQ(result.size, expected.size());
  std::size_t i = 0;
  for (const auto& [voxel, centroid] : expected) {
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_EQ(result.points[3 * i + static_cast<std::size_t>(axis)],
                static_cast<float>(centroid[axis]));
    ++i;
  }
}

TEST(VoxelGrid, NumbersVoxelsHoweverFarApartTheyLie)
{
  // Voxels of 1 mm over 10^12 m on every axis: 150 bits.
  Points points;
  for (const float far : {-1e12f, 0.0f, 1e12f})
    for (int i = 0; i < 30; ++i)
      for (const int step : {i % 6, i / 6, i % 2})
        points.push_back(far + 0.002f * static_cast<float>(step));
  // Far off, single precision resolves no neighbours; around 0 there are some.
  const DescribedCloud result =
      FeatureExtractor(1).describe(viewOf(points), withVoxel(0.001, 0.02));
  EXPECT_GT(result.size, 3u);
  for (std::size_t i = 0; i < result.size; ++i)
    EXPECT_LT(std::abs(result.points[3 * i]), 1);
}

TEST(VoxelGrid, RefusesCoordinatesThatNoIntegerHolds)
{
  const Points points{0, 0, 0, 1, 1, 1, 3e38f, 0, 0};
  EXPECT_THROW(describe(points, 0.1), std::invalid_argument);
}

TEST(FeatureExtractor, WithoutVoxelsKeepsEveryPointInOrder)
{
  const Points points = made::roomPoints(100);
  const DescribedCloud result =
      FeatureExtractor(1).describe(viewOf(points), withVoxel(0, 1));
  EXPECT_EQ(result.points, points);
}

TEST(FeatureExtractor, SkipsPointsThatAreNotFinite)
{
  const Points points = made::roomPoints();
  Points spoiled = points;
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = spoiled.size();
      spoiled.insert(spoiled.begin() + 30, {1, 1, 1});
      ASSERT_EQ(spoiled.size(), at + 3);
      spoiled[30 + axis] = bad;
    }
  expectSame(describe(spoiled, 0.1), describe(points, 0.1));
}

TEST(FeatureExtractor, HonoursStrideAndIndices)
{
  const made::EveryThird some(made::roomPoints());
  expectSame(
      FeatureExtractor(1).describe(some.view(), FeatureParameters::fromResolution(0.1)),
      describe(some.picked, 0.1));
}

TEST(FeatureExtractor, OfNothingIsNothing)
{
  const float nowhere[3] = {std::numeric_limits<float>::quiet_NaN(), 0, 0};
  const std::int32_t none = 0;
  FeatureExtractor extractor(1);
  const FeatureParameters parameters;
  EXPECT_EQ(extractor.describe({}, parameters).size, 0u);
  EXPECT_EQ(extractor.describe({nowhere, 1, 3}, parameters).size, 0u);
  EXPECT_EQ(extractor.describe({nowhere, 1, 3, &none, 0}, parameters).size, 0u);
  const Points two{0, 0, 0, 0.06f, 0, 0};
  EXPECT_EQ(describe(two, 0.05).size, 0u);
}

TEST(FeatureExtractor, RefusesWhatIsOutOfRange)
{
  const Points points = made::roomPoints(50);
  FeatureExtractor extractor(1);
  const auto refuses = [&](const PointView& view, const FeatureParameters& parameters) {
    EXPECT_THROW(extractor.describe(view, parameters), std::invalid_argument);
  };
  const FeatureParameters good;
  const auto size = static_cast<std::int32_t>(points.size() / 3);
  for (const std::int32_t index : {-1, size})
    refuses({points.data(), points.size() / 3, 3, &index, 1}, good);
  refuses({points.data(), points.size() / 3, 2}, good);
  refuses({nullptr, 1, 3}, good);
  for (const double bad : {-1.0,
                           std::numeric_limits<double>::quiet_NaN(),
                           std::numeric_limits<double>::infinity(),
                           1e-30}) {
    FeatureParameters parameters;
    parameters.voxel_size = bad;
    refuses(viewOf(points), parameters);
    parameters = good;
    parameters.normal_radius = bad;
    refuses(viewOf(points), parameters);
    parameters = good;
    parameters.feature_radius = bad;
    refuses(viewOf(points), parameters);
    EXPECT_THROW(FeatureParameters::fromResolution(bad), std::invalid_argument);
  }
  FeatureParameters parameters;
  parameters.feature_radius = 0.5 * parameters.normal_radius;
  refuses(viewOf(points), parameters);
  parameters = good;
  parameters.viewpoint[1] = std::numeric_limits<float>::quiet_NaN();
  refuses(viewOf(points), parameters);
  // The object is as good as before.
  expectSame(extractor.describe(viewOf(points), good), describe(points, 0.05));
}

TEST(Normals, StandOnSurfacesAndPointToTheSensor)
{
  // A sphere seen from its middle, then from outside.
  made::Random random(5);
  Points points;
  for (int i = 0; i < 4000; ++i) {
    Eigen::Vector3d p(random.normal(), random.normal(), random.normal());
    p.normalize();
    for (int axis = 0; axis < 3; ++axis)
      points.push_back(static_cast<float>(p[axis]));
  }
  for (const float distance : {0.0f, 10.0f}) {
    FeatureParameters parameters = FeatureParameters::fromResolution(0.1);
    parameters.viewpoint[0] = distance;
    const DescribedCloud result =
        FeatureExtractor(1).describe(viewOf(points), parameters);
    ASSERT_GT(result.size, 500u);
    for (std::size_t i = 0; i < result.size; ++i) {
      const Eigen::Vector3f point(&result.points[3 * i]), n(&result.normals[3 * i]);
      EXPECT_NEAR(n.norm(), 1, 1e-6);
      EXPECT_GT(std::abs(n.dot(point.normalized())), 0.97);
      EXPECT_GE(n.dot(Eigen::Vector3f(distance, 0, 0) - point), 0);
      EXPECT_LT(result.curvatures[i], 0.05);
      EXPECT_GE(result.curvatures[i], 0);
    }
  }
}

TEST(Descriptors, SumUpToAHundredAThird)
{
  const DescribedCloud result = describe(made::roomPoints(), 0.1);
  ASSERT_EQ(result.descriptors.size(), 33 * result.size);
  ASSERT_EQ(result.features().size, result.size);
  for (std::size_t i = 0; i < result.size; ++i)
    for (std::size_t third = 0; third < 3; ++third) {
      const float* bins = &result.descriptors[33 * i + 11 * third];
      ASSERT_NEAR(std::accumulate(bins, bins + 11, 0.0f), 100, 1e-3);
    }
}

TEST(Descriptors, DoNotChangeWithTheFrame)
{
  // Without voxels, which are tied to the axes, a turned cloud has the same descriptors
  // but for pairs on the border of two bins.
  const Points points = made::roomPoints(60);
  const Eigen::Isometry3f turn =
      Eigen::Translation3f(3, -2, 1) *
      Eigen::AngleAxisf(1.1f, Eigen::Vector3f(0.3f, -0.5f, 0.8f).normalized());
  Points turned;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    const Eigen::Vector3f p = turn * Eigen::Vector3f(&points[i]);
    turned.insert(turned.end(), p.data(), p.data() + 3);
  }
  FeatureParameters parameters = withVoxel(0, 0.5);
  parameters.normal_radius = 0.3;
  Eigen::Vector3f::Map(parameters.viewpoint) = Eigen::Vector3f(1, 1, 1);
  const DescribedCloud before =
      FeatureExtractor(1).describe(viewOf(points), parameters);
  Eigen::Vector3f::Map(parameters.viewpoint) = turn * Eigen::Vector3f(1, 1, 1);
  const DescribedCloud after = FeatureExtractor(1).describe(viewOf(turned), parameters);
  ASSERT_EQ(before.size, after.size);
  std::size_t close = 0;
  for (std::size_t i = 0; i < before.size; ++i) {
    float largest = 0;
    for (std::size_t bin = 0; bin < 33; ++bin)
      largest = std::max(
          largest,
          std::abs(before.descriptors[33 * i + bin] - after.descriptors[33 * i + bin]));
    close += largest < 1 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(close), 0.95 * static_cast<double>(before.size));
}

} // namespace pcl_flashreg
