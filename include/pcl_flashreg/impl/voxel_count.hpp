// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief How many voxels the middle of a cloud occupies, as a function of their
 * size; the middle is a box that holds the middle 80 % of the points on every axis.
 *
 * All voxel sizes that are a power of two times the finest come out of one sort: points
 * are ordered by the Morton code of their finest voxel, and the highest bit in which
 * two neighbours differ says up to which size they lie in different voxels.
 */
class VoxelCount {
public:
  /** \brief \throws std::invalid_argument if there are fewer than two distinct points
   */
  explicit VoxelCount(const pcl::PointCloud<pcl::PointXYZ>& points)
  {
    setBox(points);
    const std::vector<std::uint64_t> codes = sortedCodes(points);
    std::array<std::size_t, levels> pairs_split_at{};
    for (std::size_t i = 1; i < codes.size(); ++i)
      if (codes[i] != codes[i - 1])
        ++pairs_split_at[highestBit(codes[i] ^ codes[i - 1]) / 3];
    // A pair that is apart at one level is apart at every finer one.
    counts_[levels] = 1;
    for (int level = levels - 1; level >= 0; --level)
      counts_[level] = counts_[level + 1] + pairs_split_at[level];
    if (counts_[0] < 2)
      throw std::invalid_argument(
          "fewer than two distinct points to estimate a resolution from");
  }

  /** \brief Points of the middle that differ at the finest voxel size. */
  std::size_t
  distinctPoints() const
  {
    return counts_[0];
  }

  /** \brief The voxel size at which `count` voxels are occupied, interpolated between
   * powers of two; count in [2, distinctPoints()]. */
  double
  sizeFor(double count) const
  {
    int level = 0;
    while (counts_[level + 1] >= count)
      ++level;
    const double finer = std::log(static_cast<double>(counts_[level]));
    const double coarser = std::log(static_cast<double>(counts_[level + 1]));
    const double t = (finer - std::log(count)) / (finer - coarser);
    return finest_ * std::exp2(level + t);
  }

private:
  /** \brief Bits an axis: 2^21 of the finest voxels span the box. */
  static constexpr int levels = 21;

  /** \brief The middle 80 % on every axis: what lies far off, or thinly spread as the
   * far end of a lidar sweep, has no say. */
  void
  setBox(const pcl::PointCloud<pcl::PointXYZ>& points)
  {
    double edge = 0;
    std::vector<float> values(points.size());
    for (int axis = 0; axis < 3 && !points.empty(); ++axis) {
      for (std::size_t i = 0; i < points.size(); ++i)
        values[i] = points[i].data[axis];
      const std::size_t tail = values.size() / 10;
      const auto low = values.begin() + tail;
      const auto high = values.end() - 1 - tail;
      std::nth_element(values.begin(), low, values.end());
      low_[axis] = *low;
      std::nth_element(values.begin(), high, values.end());
      high_[axis] = *high;
      edge = std::max(edge, high_[axis] - low_[axis]);
    }
    finest_ = edge / (1 << levels);
  }

  /** \brief Of the points in the box; ascending. */
  std::vector<std::uint64_t>
  sortedCodes(const pcl::PointCloud<pcl::PointXYZ>& points) const
  {
    std::vector<std::uint64_t> codes;
    codes.reserve(points.size());
    for (const auto& point : points) {
      std::uint64_t code = 0;
      bool inside = finest_ > 0;
      for (int axis = 0; axis < 3 && inside; ++axis) {
        const double value = point.data[axis];
        inside = low_[axis] <= value && value <= high_[axis];
        const double cell = inside ? (value - low_[axis]) / finest_ : 0;
        code |= spread(std::min<std::uint64_t>(cell, (1 << levels) - 1)) << axis;
      }
      if (inside)
        codes.push_back(code);
    }
    std::sort(codes.begin(), codes.end());
    return codes;
  }

  /** \brief Puts two zero bits between the 21 bits of an axis. */
  static std::uint64_t
  spread(std::uint64_t bits)
  {
    bits = (bits | bits << 32) & 0x001f00000000ffffULL;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
    return (bits | bits << 2) & 0x1249249249249249ULL;
  }

  static int
  highestBit(std::uint64_t bits)
  {
    int position = 0;
    while (bits >>= 1)
      ++position;
    return position;
  }

  std::array<double, 3> low_{};
  std::array<double, 3> high_{};
  /** \brief Edge of the finest voxel. */
  double finest_ = 0;
  /** \brief Occupied voxels of edge finest_ * 2^level. */
  std::array<std::size_t, levels + 1> counts_{};
};

/** \brief The nearest (in ratio) of ten numbers a decade. */
inline double
roundToPreferredNumber(double value)
{
  constexpr double steps[] = {1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8, 10};
  // Powers of ten are exact upwards only, so that dividing by one gives the double that is
  // printed as it is meant.
  const double exponent = std::floor(std::log10(value));
  const double power = std::pow(10.0, std::abs(exponent));
  const auto scaled = [&](double step) {
    return exponent < 0 ? step / power : step * power;
  };
  const auto distance = [&](double step) {
    return std::abs(std::log(value / scaled(step)));
  };
  double best = steps[0];
  for (const double step : steps)
    if (distance(step) < distance(best))
      best = step;
  return scaled(best);
}

} // namespace detail
} // namespace pcl_flashreg
