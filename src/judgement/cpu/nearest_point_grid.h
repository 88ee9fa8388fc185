// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/array.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief Which point of a cloud is near a place, by two look-ups.
 *
 * Cubic cells, in blocks of 8 x 8 x 8 where there are points, and a hash of the blocks, which
 * stays in the innermost cache. Every point is entered into its own cell and into those
 * around it, and a cell keeps the point nearest to its centre. So the answer is the nearest
 * point to within about the side of a cell, and there is one for every place within 1.4 sides
 * of a point.
 */
class NearestPointGrid {
public:
  /** \param[in] points finite; fewer than 2^31
   * \param[in] side of a cell, > 0 */
  void
  build(const Array<Eigen::Vector3f>& points, float side);

  struct Block {
    std::uint64_t key = FREE;
    std::uint64_t first_cell = 0;
  };

  /** \brief What restore() takes, of a grid of the same points. */
  float
  side() const
  {
    return side_;
  }
  const Array<Block>&
  blocks() const
  {
    return blocks_;
  }
  const Array<int>&
  cells() const
  {
    return cells_;
  }

  /** \param[in] points how many there are
   * \return whether these can be parts of a grid; if not, it must not be asked */
  bool
  restore(float side, Array<Block> blocks, Array<int> cells, std::size_t points);

  /** \return number of a point, -1 if there is none near */
  int
  find(const Eigen::Vector3f& place) const
  {
    const Eigen::Vector3i cell = cellOf(place);
    const int point =
        cells_[blocks_[slotOf(blocks_, keyOf(cell))].first_cell + offsetOf(cell)];
    // Of a file, nobody has looked at all of them.
    return point < points_ ? point : -1;
  }

  /** \brief Of memory. */
  std::size_t
  bytes() const
  {
    return blocks_.bytes() + cells_.bytes() + distances_.capacity() * sizeof(float);
  }

private:
  static constexpr int SHIFT = 3, EDGE = 1 << SHIFT;
  static constexpr std::size_t CELLS_A_BLOCK = EDGE * EDGE * EDGE;
  /** \brief Marks a slot that no block is in; its cells are those of the empty block 0. */
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

  /** \brief Of the block that the cell is in. */
  static std::uint64_t
  keyOf(const Eigen::Vector3i& cell)
  {
    const auto part = [](int x) {
      return static_cast<std::uint64_t>((x + HALF_RANGE) >> SHIFT);
    };
    return (part(cell.x()) << 42) | (part(cell.y()) << 21) | part(cell.z());
  }

  /** \brief Of the cell in its block. */
  static std::size_t
  offsetOf(const Eigen::Vector3i& cell)
  {
    constexpr int mask = EDGE - 1;
    return static_cast<std::size_t>(
        (((cell.x() & mask) << SHIFT | (cell.y() & mask)) << SHIFT) |
        (cell.z() & mask));
  }

  /** \brief Where the block stands, or would have to be put. */
  template <typename Blocks>
  static std::size_t
  slotOf(const Blocks& blocks, std::uint64_t key)
  {
    const std::size_t mask = blocks.size() - 1;
    std::size_t slot = ((key * 0x9E3779B97F4A7C15ull) >> 32) & mask;
    while (blocks[slot].key != FREE && blocks[slot].key != key)
      slot = (slot + 1) & mask;
    return slot;
  }

  void
  grow();
  std::size_t
  blockOf(std::uint64_t key);

  float side_ = 1, inverse_side_ = 1;
  int points_ = 0;
  Array<Block> blocks_;
  std::size_t used_ = 0;
  /** \brief Points, block by block; -1 where there is none. */
  Array<int> cells_;
  /** \brief Squared distance of the point to the centre of its cell; for building alone. */
  std::vector<float> distances_;
};

} // namespace pcl_flashreg
