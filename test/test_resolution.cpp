// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cpu/features/voxel_count.h"
#include "support/made_room.h"

#include <pcl_flashreg/resolution.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

namespace pcl_flashreg {
namespace {

using Points = std::vector<float>;

Points
room()
{
  const made::Room room(1, 400, 0.003);
  Points points;
  for (const Eigen::Vector3d& p : room.points())
    for (int axis = 0; axis < 3; ++axis)
      points.push_back(static_cast<float>(p[axis]));
  return points;
}

PointView
viewOf(const Points& points)
{
  return {points.data(), points.size() / 3, 3};
}

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
  expectCountsOf(room());
}

TEST(VoxelCount, StraysMayStretchTheExtent)
{
  Points points = room();
  const float most = std::numeric_limits<float>::max();
  for (const float far : {-most, most, 1e9f})
    points.insert(points.end(), {far, -far, far});
  expectCountsOf(points);
}

TEST(VoxelCount, PlanesAndRepeatedValuesAreCloudsToo)
{
  Points plane = room();
  for (std::size_t i = 0; i < plane.size(); i += 3) {
    plane[i] = 7;
    plane[i + 1] = std::round(10 * plane[i + 1]) / 10;
  }
  expectCountsOf(plane);
}

TEST(EstimateResolution, UsesThePointsOfTheView)
{
  const Points points = room();
  Points wide, half;
  std::vector<std::int32_t> indices;
  for (std::size_t i = 0; i < points.size() / 3; ++i) {
    wide.insert(wide.end(), &points[3 * i], &points[3 * i] + 3);
    wide.insert(wide.end(), {7, std::numeric_limits<float>::quiet_NaN()});
    if (i % 3 == 1) {
      half.insert(half.end(), &points[3 * i], &points[3 * i] + 3);
      indices.push_back(static_cast<std::int32_t>(i));
    }
  }
  const PointView view{wide.data(), wide.size() / 5, 5, indices.data(), indices.size()};
  EXPECT_EQ(estimateResolution(view), estimateResolution(viewOf(half)));
  EXPECT_EQ(estimateVoxelSize(view), estimateVoxelSize(viewOf(half)));
  EXPECT_NE(estimateVoxelSize(view), estimateVoxelSize(viewOf(points)));
}

TEST(EstimateResolution, RefusesWhatIsOutOfRange)
{
  const Points points = room();
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
