// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/vicinity.h"

#include "judgement/cpu/z_order.h"
#include "math/quantile.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief Of ten points of the source one may lie farther off than it is said to reach: of a
 * lidar these are single rays. */
constexpr double SHARE_IN_REACH = 0.9;

/** \brief Cells at most: they get larger where a map has more. */
constexpr std::int64_t MOST_CELLS = 1 << 22;

float
reachOf(const Surface& cloud)
{
  std::vector<float> squared;
  squared.reserve(cloud.points.size());
  for (const Eigen::Vector3f& point : cloud.points)
    squared.push_back(point.squaredNorm());
  return std::sqrt(quantileOf(squared, SHARE_IN_REACH));
}

/** \brief Half as wide as the reach, or somewhat more. */
int
levelFor(float key_side, float reach)
{
  int level = 0;
  while (key_side * static_cast<float>(2 << level) <= reach && level + 1 < Z_ORDER_BITS)
    ++level;
  return level;
}

std::size_t
numberOf(const Eigen::Array3i& cell, const Eigen::Array3i& counts)
{
  return (static_cast<std::size_t>(cell[0]) * static_cast<std::size_t>(counts[1]) +
          static_cast<std::size_t>(cell[1])) *
             static_cast<std::size_t>(counts[2]) +
         static_cast<std::size_t>(cell[2]);
}

} // namespace

void
Vicinity::layOut(const Surface& target)
{
  int level = levelFor(target.key_side, reach_);
  Eigen::Array3i most = Eigen::Array3i::Zero();
  for (const std::uint64_t key : target.keys)
    most = most.max(cellOfZOrderKey(key));
  for (;; ++level) {
    counts_ = most / (1 << level) + 1;
    if (counts_.cast<std::int64_t>().prod() <= MOST_CELLS)
      break;
  }
  side_ = target.key_side * static_cast<float>(1 << level);
  cells_.assign(static_cast<std::size_t>(counts_.prod()), {});
  const int shift = 3 * level;
  for (std::size_t i = 0; i < target.keys.size();) {
    const std::uint64_t key = target.keys[i] >> shift;
    const std::size_t begin = i;
    while (i < target.keys.size() && target.keys[i] >> shift == key)
      ++i;
    cells_[numberOf(cellOfZOrderKey(key), counts_)] = {
        static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(i)};
  }
}

void
Vicinity::build(const Surface& source, const Surface& target)
{
  points_ = target.points.size();
  cells_.clear();
  if (source.points.empty() || target.keys.empty() ||
      !isMuchLarger(points_, source.points.size()))
    return;
  low_ = target.key_corner;
  reach_ = reachOf(source);
  layOut(target);
}

PointRanges
Vicinity::around(const Eigen::Vector3f& middle) const
{
  if (cells_.empty())
    return PointRanges(points_);
  const Eigen::Array3f place = (middle - low_).array() / side_;
  const float reach = reach_ / side_;
  // Comparisons in floating point: what is far off fits no number of a cell.
  const auto clamped = [&](const Eigen::Array3f& at) {
    return at.floor().max(0.0f).min((counts_ - 1).cast<float>()).cast<int>().eval();
  };
  const Eigen::Array3i first = clamped(place - reach), last = clamped(place + reach);
  PointRanges ranges;
  for (int x = first[0]; x <= last[0]; ++x)
    for (int y = first[1]; y <= last[1]; ++y)
      for (int z = first[2]; z <= last[2]; ++z) {
        const Eigen::Array3i cell(x, y, z);
        const PointRanges::Range& range = cells_[numberOf(cell, counts_)];
        const Eigen::Array3f corner = cell.cast<float>();
        const Eigen::Array3f off = (corner - place).max(place - (corner + 1)).max(0.0f);
        if (range.begin < range.end && off.square().sum() <= reach * reach)
          ranges.add(range);
      }
  return ranges;
}

} // namespace pcl_flashreg
