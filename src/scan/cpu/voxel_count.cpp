// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/cpu/voxel_count.h"

#include "support/radix_sort.h"
#include "scan/points.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief The elements that would stand at these two places, low < high, if the values
 * were sorted; not empty.
 *
 * The values are counted in slices of equal width, and only the two slices that hold the
 * places are searched: three passes over the values instead of the some ten of
 * std::nth_element. Where strays stretch the range, a slice holds most of the values and is
 * searched like any other.
 */
std::array<float, 2>
elementsAt(const std::array<std::size_t, 2>& places, const std::vector<float>& values)
{
  constexpr std::size_t SLICES = 4096;
  const auto range = std::minmax_element(values.begin(), values.end());
  const double first = *range.first;
  const double extent = *range.second - first;
  const double scale = extent > 0 ? (SLICES - 1) / extent : 0;
  const auto sliceOf = [&](float value) {
    return static_cast<std::size_t>((value - first) * scale);
  };
  std::array<std::size_t, SLICES + 1> begins{};
  for (const float value : values)
    ++begins[sliceOf(value) + 1];
  for (std::size_t slice = 0; slice < SLICES; ++slice)
    begins[slice + 1] += begins[slice];

  const auto sliceAt = [&](std::size_t place) {
    const auto after = std::upper_bound(begins.begin(), begins.end(), place);
    return static_cast<std::size_t>(after - begins.begin()) - 1;
  };
  const std::array<std::size_t, 2> slices = {sliceAt(places[0]), sliceAt(places[1])};
  std::array<std::vector<float>, 2> members;
  for (const float value : values) {
    const std::size_t slice = sliceOf(value);
    for (std::size_t p = 0; p < 2; ++p)
      if (slice == slices[p])
        members[p].push_back(value);
  }
  std::array<float, 2> elements{};
  for (std::size_t p = 0; p < 2; ++p) {
    const auto element =
        members[p].begin() + static_cast<std::ptrdiff_t>(places[p] - begins[slices[p]]);
    std::nth_element(members[p].begin(), element, members[p].end());
    elements[p] = *element;
  }
  return elements;
}

/** \brief Puts two zero bits between the 21 bits of an axis. */
std::uint64_t
spread(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x001f00000000ffffULL;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2) & 0x1249249249249249ULL;
}

/** \param[in] bits not 0 */
int
highestBit(std::uint64_t bits)
{
  return 63 - __builtin_clzll(bits);
}

} // namespace

VoxelCount::VoxelCount(const PointView& points)
{
  Axes axes;
  for (std::vector<float>& values : axes)
    values.reserve(countOf(points));
  for (std::size_t i = 0; i < countOf(points); ++i) {
    const float* point = pointOf(points, i);
    if (isFinite(point))
      for (std::size_t axis = 0; axis < 3; ++axis)
        axes[axis].push_back(point[axis]);
  }
  setBox(axes);
  const std::vector<std::uint64_t> codes = sortedCodes(axes);
  std::array<std::size_t, LEVELS> pairs_split_at{};
  for (std::size_t i = 1; i < codes.size(); ++i)
    if (codes[i] != codes[i - 1])
      ++pairs_split_at[highestBit(codes[i] ^ codes[i - 1]) / 3];
  // A pair that is apart at one level is apart at every finer one.
  counts_[LEVELS] = 1;
  for (int level = LEVELS - 1; level >= 0; --level)
    counts_[level] = counts_[level + 1] + pairs_split_at[level];
  if (counts_[0] < 2)
    throw std::invalid_argument(
        "fewer than two distinct points to estimate a resolution from");
}

double
VoxelCount::extent() const
{
  double extent = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    extent = std::max(extent, high_[axis] - low_[axis]);
  return extent;
}

double
VoxelCount::sizeFor(double count) const
{
  int level = 0;
  while (counts_[level + 1] >= count)
    ++level;
  const double finer = std::log(static_cast<double>(counts_[level]));
  const double coarser = std::log(static_cast<double>(counts_[level + 1]));
  const double t = (finer - std::log(count)) / (finer - coarser);
  return finest_ * std::exp2(level + t);
}

/** \brief The middle 80 % on every axis: what lies far off, or thinly spread as the
 * far end of a lidar sweep, has no say; unless the middle is one place. */
void
VoxelCount::setBox(const Axes& axes)
{
  const std::size_t size = axes[0].size();
  double edge = 0;
  for (const std::size_t tail : {size / 10, std::size_t{0}}) {
    if (edge > 0 || size == 0)
      break;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] = elementsAt({tail, size - 1 - tail}, axes[axis]);
      low_[axis] = low;
      high_[axis] = high;
      edge = std::max(edge, high_[axis] - low_[axis]);
    }
  }
  finest_ = edge / (1 << LEVELS);
}

/** \brief Of the points in the box; ascending. */
std::vector<std::uint64_t>
VoxelCount::sortedCodes(const Axes& axes) const
{
  std::vector<std::uint64_t> codes;
  if (!(finest_ > 0))
    return codes;
  codes.reserve(axes[0].size());
  for (std::size_t i = 0; i < axes[0].size(); ++i) {
    // Without branches: half of the points are inside, in no order.
    bool inside = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      inside &= (low_[axis] <= axes[axis][i]) & (axes[axis][i] <= high_[axis]);
    if (!inside)
      continue;
    std::uint64_t code = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto cell =
          static_cast<std::int64_t>((axes[axis][i] - low_[axis]) / finest_);
      code |= spread(std::min<std::uint64_t>(cell, (1 << LEVELS) - 1)) << axis;
    }
    codes.push_back(code);
  }
  radixSort(codes, 3 * LEVELS);
  return codes;
}

} // namespace cpu
} // namespace pcl_flashreg
