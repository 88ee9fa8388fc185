// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief Which point of a cloud is near a place, by one look-up.
 *
 * A hash of cubic cells; every point is entered into its own cell and into those around
 * it, and a cell keeps the point nearest to its centre. So the answer is the nearest point
 * to within about the side of a cell, and there is one for every place within 1.4 sides
 * of a point.
 */
class NearestPointGrid {
public:
  /** \param[in] points finite; the caller keeps them
   * \param[in] side of a cell, > 0 */
  void
  build(const std::vector<Eigen::Vector3f>& points, float side);

  /** \return number of a point, -1 if there is none near */
  int
  find(const Eigen::Vector3f& place) const
  {
    return cells_[slotOf(keyOf(cellOf(place)))].point;
  }

private:
  struct Cell {
    std::uint64_t key;
    int point;
  };

  /** \brief Marks a slot that no cell is in. */
  static constexpr std::uint64_t FREE = ~std::uint64_t{0};
  /** \brief Cells an axis that a key has room for, to either side of the origin. */
  static constexpr int HALF_RANGE = 1 << 20;

  /** \brief Places far outside are in a border cell, where a stray point does no harm. */
  int
  cellOf(float x) const
  {
    constexpr float limit = HALF_RANGE - 4;
    const float scaled = x * inverse_side_;
    // The comparisons turn down what is not a number, too.
    const float inside = scaled > -limit ? (scaled < limit ? scaled : limit) : -limit;
    const int truncated = static_cast<int>(inside);
    return truncated - (inside < static_cast<float>(truncated) ? 1 : 0);
  }

  Eigen::Vector3i
  cellOf(const Eigen::Vector3f& place) const
  {
    return {cellOf(place.x()), cellOf(place.y()), cellOf(place.z())};
  }

  static std::uint64_t
  keyOf(const Eigen::Vector3i& cell)
  {
    const auto part = [](int x) { return static_cast<std::uint64_t>(x + HALF_RANGE); };
    return (part(cell.x()) << 42) | (part(cell.y()) << 21) | part(cell.z());
  }

  /** \brief Where the key stands, or would have to be put. */
  std::size_t
  slotOf(std::uint64_t key) const
  {
    const std::size_t mask = cells_.size() - 1;
    std::size_t slot = ((key * 0x9E3779B97F4A7C15ull) >> 32) & mask;
    while (cells_[slot].key != FREE && cells_[slot].key != key)
      slot = (slot + 1) & mask;
    return slot;
  }

  void
  resize(std::size_t capacity);
  void
  enter(int point, const Eigen::Vector3f& place, const Eigen::Vector3i& cell);

  const std::vector<Eigen::Vector3f>* points_ = nullptr;
  float side_ = 1, inverse_side_ = 1;
  std::vector<Cell> cells_;
  std::size_t used_ = 0;
};

} // namespace pcl_flashreg
