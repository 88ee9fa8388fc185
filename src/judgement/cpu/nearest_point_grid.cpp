// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/nearest_point_grid.h"

#include <array>
#include <limits>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Cells that a point is entered into reach from its own cell to here, squared. */
constexpr int SQUARED_REACH = 5;
constexpr std::size_t CELLS_IN_REACH = 57;

constexpr std::size_t MIN_SLOTS = 64;

std::array<Eigen::Vector3i, CELLS_IN_REACH>
cellsInReach()
{
  std::array<Eigen::Vector3i, CELLS_IN_REACH> cells;
  std::size_t count = 0;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (x * x + y * y + z * z <= SQUARED_REACH)
          cells[count++] = {x, y, z};
  return cells;
}

} // namespace

void
NearestPointGrid::grow()
{
  std::vector<Block>& blocks = blocks_.own();
  std::vector<Block> old(2 * blocks.size());
  old.swap(blocks);
  for (const Block& block : old)
    if (block.key != FREE)
      blocks[slotOf(blocks, block.key)] = block;
}

/** \return first cell of the block, which is made if it is not there yet */
std::size_t
NearestPointGrid::blockOf(std::uint64_t key)
{
  std::vector<Block>& blocks = blocks_.own();
  std::vector<int>& cells = cells_.own();
  const std::size_t slot = slotOf(blocks, key);
  if (blocks[slot].key == key)
    return blocks[slot].first_cell;
  const std::size_t first = cells.size();
  blocks[slot] = {key, first};
  cells.resize(first + CELLS_A_BLOCK, -1);
  distances_.resize(first + CELLS_A_BLOCK, std::numeric_limits<float>::infinity());
  if (2 * ++used_ > blocks.size())
    grow();
  return first;
}

void
NearestPointGrid::build(const Array<Eigen::Vector3f>& points, float side)
{
  static const std::array<Eigen::Vector3i, CELLS_IN_REACH> reach = cellsInReach();
  side_ = side;
  inverse_side_ = 1 / side;
  points_ = static_cast<int>(points.size());
  used_ = 0;
  blocks_.own().assign(MIN_SLOTS, Block{});
  std::vector<int>& cells = cells_.own();
  cells.assign(CELLS_A_BLOCK, -1);
  distances_.assign(CELLS_A_BLOCK, 0);
  std::uint64_t last = FREE;
  std::size_t first = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3i own = cellOf(points[i]);
    for (const Eigen::Vector3i& step : reach) {
      const Eigen::Vector3i cell = own + step;
      if (const std::uint64_t key = keyOf(cell); key != last) {
        first = blockOf(key);
        last = key;
      }
      const std::size_t at = first + offsetOf(cell);
      const Eigen::Vector3f centre =
          side_ * (cell.cast<float>() + Eigen::Vector3f::Constant(0.5f));
      const float squared = (points[i] - centre).squaredNorm();
      if (squared < distances_[at]) {
        distances_[at] = squared;
        cells[at] = static_cast<int>(i);
      }
    }
  }
  blocks_.seal();
  cells_.seal();
}

bool
NearestPointGrid::restore(float side,
                          Array<Block> blocks,
                          Array<int> cells,
                          std::size_t points)
{
  side_ = side;
  inverse_side_ = 1 / side;
  points_ = static_cast<int>(points);
  blocks_ = std::move(blocks);
  cells_ = std::move(cells);
  const std::size_t size = blocks_.size();
  // A search ends at a slot that is free.
  bool has_free = false, inside = cells_.size() >= CELLS_A_BLOCK;
  for (const Block& block : blocks_) {
    has_free |= block.key == FREE;
    inside &= block.first_cell <= cells_.size() &&
              cells_.size() - block.first_cell >= CELLS_A_BLOCK;
  }
  return side > 0 && size > 0 && (size & (size - 1)) == 0 && has_free && inside;
}

} // namespace pcl_flashreg
