// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Clouds with thousands of equal points, as beams without a return leave them: what is done
// for each place is done once, and every point gets it.

#include "scan/cpu/feature_stages.h"
#include "support/point_rows.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

using made::Points;
using made::viewOf;

constexpr double REACH = 0.25;

/** \brief Every point is a keypoint. */
FeatureParameters
withoutVoxels()
{
  FeatureParameters parameters;
  parameters.voxel_size = 0;
  parameters.normal_radius = REACH;
  parameters.feature_radius = REACH;
  return parameters;
}

/** \brief A point many times, before and behind the others. */
Points
withCopies(const Points& points, const Points& copied, std::size_t copies)
{
  Points all;
  for (std::size_t i = 0; i < copies; ++i) {
    if (i == copies / 2)
      all.insert(all.end(), points.begin(), points.end());
    all.insert(all.end(), copied.begin(), copied.end());
  }
  return all;
}

/** \brief What a description of a cloud does, as its hot loops see it. */
struct Work {
  /** \brief Searches for neighbours. */
  std::atomic<std::size_t> searches{0};
  /** \brief Histograms of single points that were added up, and those of them in which
   * there is nothing. */
  std::atomic<std::size_t> added{0}, empty{0};
};
Work work;
cpu::Kernels plain;

template <typename... Arguments>
std::size_t
searchAndCount(Arguments... arguments)
{
  ++work.searches;
  return plain.collectNeighbors(arguments...);
}

void
addAndCount(const float* rows,
            const std::uint32_t* indices,
            const float* weights,
            std::size_t count,
            float* sum)
{
  work.added += count;
  for (std::size_t n = 0; n < count; ++n) {
    const float* row = rows + indices[n] * cpu::HISTOGRAM_STRIDE;
    work.empty +=
        std::all_of(row, row + cpu::FPFH_BINS, [](float bin) { return bin == 0; });
  }
  plain.weightedRowSum(rows, indices, weights, count, sum);
}

/** \return how many points are described */
std::size_t
describeAndCount(const Points& points)
{
  plain = cpu::selectKernels();
  cpu::Kernels counting = plain;
  counting.collectNeighbors = &searchAndCount;
  counting.weightedRowSum = &addAndCount;
  ThreadPool pool(2);
  cpu::FeatureStages stages(counting, pool);
  FeatureTimings timings;
  work.searches = work.added = work.empty = 0;
  findSurface(
      stages, viewOf(points), {}, withoutVoxels(), ScanContent::Descriptors, timings);
  describeSurface(stages, withoutVoxels(), timings);
  return stages.takeResult(ScanContent::Descriptors, false).size;
}

TEST(EqualPoints, AreSearchedForOnce)
{
  const Points points = made::roomPoints(60);
  const std::size_t size = points.size() / 3;
  EXPECT_EQ(describeAndCount(points), size);
  EXPECT_EQ(work.searches, 3 * size);
  const std::size_t pairs = work.added;
  EXPECT_EQ(work.empty, 0u);

  // One that has neighbours: all of its copies count there.
  const Points near(points.begin() + 30, points.begin() + 33);
  EXPECT_EQ(describeAndCount(withCopies(points, near, 500)), size + 500);
  EXPECT_EQ(work.searches, 3 * size);
  EXPECT_GT(work.added, pairs + 500);
  EXPECT_EQ(work.added % 500, pairs % 500);
  EXPECT_EQ(work.empty, 0u);

  // One that has none besides its copies has no normal, and is gone.
  EXPECT_EQ(describeAndCount(withCopies(points, {-9, -9, -9}, 500)), size);
  EXPECT_EQ(work.searches, 3 * size + 1);
  EXPECT_EQ(work.added, pairs);
}

TEST(EqualPoints, AreDescribedAlike)
{
  const Points points = made::roomPoints(60);
  constexpr std::size_t COPIES = 100, AT = 10;
  const Points copied(points.begin() + 3 * AT, points.begin() + 3 * AT + 3);
  const Points all = withCopies(points, copied, COPIES);
  const DescribedCloud cloud =
      FeatureExtractor(2).describe(viewOf(all), withoutVoxels());
  ASSERT_EQ(cloud.points, all);
  const auto row = [&](const std::vector<float>& values, std::size_t i) {
    const std::size_t width = values.size() / cloud.size;
    return std::vector<float>(&values[i * width], &values[i * width] + width);
  };
  for (std::size_t i = 0; i < cloud.size; ++i)
    if (i < COPIES / 2 || i >= cloud.size - COPIES / 2 || i == COPIES / 2 + AT) {
      EXPECT_EQ(row(cloud.points, i), copied);
      EXPECT_EQ(row(cloud.normals, i), row(cloud.normals, 0));
      EXPECT_EQ(row(cloud.descriptors, i), row(cloud.descriptors, 0));
      EXPECT_EQ(cloud.curvatures[i], cloud.curvatures[0]);
    }
}

/** \brief Twice as many neighbours everywhere: what is spread how, and the shares of pairs
 * that are alike, stay nearly as they were. */
TEST(EqualPoints, ThatAreTwoOfEachAreDescribedNearlyLikeOne)
{
  const Points points = made::roomPoints(200);
  Points twice = points;
  twice.insert(twice.end(), points.begin(), points.end());
  FeatureExtractor extractor(2);
  const DescribedCloud one = extractor.describe(viewOf(points), withoutVoxels());
  const DescribedCloud two = extractor.describe(viewOf(twice), withoutVoxels());
  ASSERT_EQ(two.size, 2 * one.size);
  std::size_t alike = 0;
  for (std::size_t i = 0; i < two.size; ++i) {
    const std::size_t single = i % one.size;
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_NEAR(two.normals[3 * i + axis], one.normals[3 * single + axis], 1e-3);
    ASSERT_NEAR(two.curvatures[i], one.curvatures[single], 1e-5);
    float largest = 0;
    for (std::size_t bin = 0; bin < 33; ++bin)
      largest = std::max(
          largest,
          std::abs(two.descriptors[33 * i + bin] - one.descriptors[33 * single + bin]));
    alike += largest < 1 ? 1 : 0;
  }
  // Pairs on the border of two bins may change sides.
  EXPECT_GT(static_cast<double>(alike), 0.98 * static_cast<double>(two.size));
}

TEST(EqualPoints, KeepTheNormalsThatTheyCameWith)
{
  const Points points = made::roomPoints(60);
  const Points all =
      withCopies(points, Points(points.begin() + 30, points.begin() + 33), 8);
  const std::size_t size = all.size() / 3;
  const std::vector<float> descriptors(size, 1.0f);
  ScanInput<float> input;
  input.points = viewOf(all);
  input.features = {descriptors.data(), size, 1, 1};
  PairRegistration registration(BackendKind::Cpu, 2);
  const Scan computed = registration.makeScan(input, REACH / 2);
  // Some have one, some not: of the copies the first, which stands for the others, and one
  // of the last.
  constexpr float NONE = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> normals(all.size(), NONE);
  for (const std::size_t i : {std::size_t{0}, size / 2, size - 2}) {
    normals[3 * i] = normals[3 * i + 1] = 0;
    normals[3 * i + 2] = 2;
  }
  input.normals = normals.data();
  const Scan given = registration.makeScan(input, REACH / 2);
  ASSERT_EQ(given.size(), size);
  for (std::size_t i = 0; i < size; ++i) {
    const float* normal = given.normals() + 3 * i;
    if (!std::isnan(normals[3 * i])) {
      EXPECT_EQ(std::abs(normal[2]), 1);
      EXPECT_EQ(given.curvatures()[i], 0);
      continue;
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(normal[axis], computed.normals()[3 * i + axis]) << i;
    EXPECT_EQ(given.curvatures()[i], computed.curvatures()[i]);
  }
}

} // namespace
} // namespace pcl_flashreg
