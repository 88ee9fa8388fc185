// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief Smallest and largest coordinates of points. */
struct Bounds {
  std::array<float, 3> low, high;

  Bounds()
  {
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
  }

  void
  add(const float* point)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], point[axis]);
      high[axis] = std::max(high[axis], point[axis]);
    }
  }

  void
  add(const Bounds& other)
  {
    add(other.low.data());
    add(other.high.data());
  }
};

/** \brief Numbers the cells of a uniform grid with 64 bits, in the order z, y, x: cells that
 * are neighbours in x have successive numbers. One empty cell is left on every side, so
 * that a neighbour's number is always one of the right row.
 *
 * However far apart points lie, the numbers suffice: where 64 bits are too few for all
 * cells, slabs that no point lies in are left out, all but one of each gap.
 * \tparam Floor from a float coordinate to the integral coordinate of its cell, a double;
 * monotone
 */
template <typename Floor>
class CellNumbering {
public:
  /** \param[in] point i -> const float*, three finite coordinates, i in [0, count)
   * \throws std::invalid_argument if a cell's coordinate is beyond 2^53, or there are too
   * many slabs with points
   */
  template <typename PointAt>
  CellNumbering(Floor floor,
                const Bounds& bounds,
                std::size_t count,
                const PointAt& point)
      : floor_(floor)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin_[axis] = floor_(bounds.low[axis]) - 1;
      const double last = floor_(bounds.high[axis]) + 1;
      if (!(std::abs(origin_[axis]) < LARGEST && std::abs(last) < LARGEST))
        throw std::invalid_argument(TOO_SMALL);
      setBits(axis, static_cast<std::uint64_t>(last - origin_[axis]));
    }
    for (std::size_t axis = 0; axis < 3 && bits() > 64; ++axis)
      leaveOutEmptySlabs(axis, count, point);
    if (bits() > 64)
      throw std::invalid_argument(TOO_SMALL);
  }

  std::uint64_t
  key(const float* point) const
  {
    return coordinate(2, point) << (bits_[0] + bits_[1]) |
           coordinate(1, point) << bits_[0] | coordinate(0, point);
  }

  /** \brief Number of the cell that lies one further in y, or z, less this one's. */
  std::uint64_t
  yStep() const
  {
    return std::uint64_t{1} << bits_[0];
  }
  std::uint64_t
  zStep() const
  {
    return std::uint64_t{1} << (bits_[0] + bits_[1]);
  }

  /** \brief Bits of a number. */
  int
  bits() const
  {
    return bits_[0] + bits_[1] + bits_[2];
  }

private:
  static constexpr double LARGEST = 9007199254740992.0; // 2^53
  static constexpr const char* TOO_SMALL =
      "the cells are too small for the extent of the cloud: they can't be numbered";

  void
  setBits(std::size_t axis, std::uint64_t last)
  {
    bits_[axis] = 1;
    while (bits_[axis] < 64 && last >> bits_[axis] != 0)
      ++bits_[axis];
  }

  std::uint64_t
  coordinate(std::size_t axis, const float* point) const
  {
    const double cell = floor_(point[axis]);
    const std::vector<double>& slabs = slabs_[axis];
    if (slabs.empty())
      return static_cast<std::uint64_t>(cell - origin_[axis]);
    const auto at = std::lower_bound(slabs.begin(), slabs.end(), cell) - slabs.begin();
    return numbers_[axis][static_cast<std::size_t>(at)];
  }

  template <typename PointAt>
  void
  leaveOutEmptySlabs(std::size_t axis, std::size_t count, const PointAt& point)
  {
    std::vector<double>& slabs = slabs_[axis];
    slabs.reserve(count);
    for (std::size_t i = 0; i < count; ++i)
      slabs.push_back(floor_(point(i)[axis]));
    std::sort(slabs.begin(), slabs.end());
    slabs.erase(std::unique(slabs.begin(), slabs.end()), slabs.end());
    std::uint64_t number = 1;
    for (std::size_t s = 0; s < slabs.size(); ++s) {
      if (s > 0)
        number += slabs[s] - slabs[s - 1] > 1 ? 2 : 1;
      numbers_[axis].push_back(number);
    }
    setBits(axis, number + 1);
  }

  Floor floor_;
  std::array<double, 3> origin_;
  std::array<int, 3> bits_;
  /** \brief Where slabs were left out: the others, ascending, and their numbers. */
  std::array<std::vector<double>, 3> slabs_;
  std::array<std::vector<std::uint64_t>, 3> numbers_;
};

} // namespace cpu
} // namespace pcl_flashreg
