// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/cpu/voxel_count.h"
#include "support/point_rows.h"

#include <pcl_flashreg/resolution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace pcl_flashreg {
namespace {

using made::Points;
using made::viewOf;

struct Box {
  std::array<double, 3> low, high;
  double edge = 0;
};

/** \brief The middle 80 % on every axis, by sorting. */
Box
middleOf(const Points& points)
{
  Box box;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Points values;
    for (std::size_t i = axis; i < points.size(); i += 3)
      values.push_back(points[i]);
    std::sort(values.begin(), values.end());
    box.low[axis] = values[values.size() / 10];
    box.high[axis] = values[values.size() - 1 - values.size() / 10];
    box.edge = std::max(box.edge, box.high[axis] - box.low[axis]);
  }
  return box;
}

std::size_t
occupied(const Points& points, const Box& box, double size)
{
  std::set<std::array<long, 3>> voxels;
  for (std::size_t i = 0; i < points.size(); i += 3) {
    std::array<long, 3> voxel;
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = points[i + axis];
      inside = inside && box.low[axis] <= value && value <= box.high[axis];
      // The last voxel has the box's far side.
      voxel[axis] = std::min(static_cast<long>((value - box.low[axis]) / size),
                             std::lround(box.edge / size) - 1);
    }
    if (inside)
      voxels.insert(voxel);
  }
  return voxels.size();
}

void
expectCountsOf(const Points& points)
{
  const cpu::VoxelCount count(viewOf(points));
  const Box box = middleOf(points);
  for (int halvings = 2; halvings <= 8; ++halvings) {
    const double size = std::ldexp(box.edge, -halvings);
    const auto voxels = static_cast<double>(occupied(points, box, size));
    EXPECT_NEAR(count.sizeFor(voxels) / size, 1, 1e-12) << halvings;
  }
}

TEST(VoxelCount, IsThatOfPlainGrids)
{
  expectCountsOf(made::roomPoints());
}

TEST(VoxelCount, StraysMayStretchTheExtent)
{
  Points points = made::roomPoints();
  const float most = std::numeric_limits<float>::max();
  for (const float far : {-most, most, 1e9f})
    points.insert(points.end(), {far, -far, far});
  expectCountsOf(points);
}

TEST(VoxelCount, PlanesAndRepeatedValuesAreCloudsToo)
{
  Points plane = made::roomPoints();
  for (std::size_t i = 0; i < plane.size(); i += 3) {
    plane[i] = 7;
    plane[i + 1] = std::round(10 * plane[i + 1]) / 10;
  }
  expectCountsOf(plane);
}

TEST(EstimateResolution, UsesThePointsOfTheView)
{
  const Points points = made::roomPoints();
  const made::EveryThird some(points);
  EXPECT_EQ(estimateResolution(some.view()), estimateResolution(viewOf(some.picked)));
  EXPECT_EQ(estimateVoxelSize(some.view()), estimateVoxelSize(viewOf(some.picked)));
  EXPECT_NE(estimateVoxelSize(some.view()), estimateVoxelSize(viewOf(points)));
}

TEST(EstimateResolution, RefusesWhatIsOutOfRange)
{
  const Points points = made::roomPoints();
  const auto size = static_cast<std::int32_t>(points.size() / 3);
  for (const std::int32_t index : {-1, size}) {
    const PointView view{points.data(), points.size() / 3, 3, &index, 1};
    EXPECT_THROW(estimateResolution(view), std::invalid_argument);
    EXPECT_THROW(estimateVoxelSize(view), std::invalid_argument);
  }
  EXPECT_THROW(estimateResolution({points.data(), points.size() / 3, 2}),
               std::invalid_argument);
  EXPECT_THROW(estimateResolution({}), std::invalid_argument);
}

} // namespace
} // namespace pcl_flashreg
