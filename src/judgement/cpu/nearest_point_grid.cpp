// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/nearest_point_grid.h"

#include <array>
#include <limits>

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
  std::vector<Block> old(2 * blocks_.size());
  old.swap(blocks_);
  for (const Block& block : old)
    if (block.key != FREE)
      blocks_[slotOf(block.key)] = block;
}

/** \return first cell of the block, which is made if it is not there yet */
std::size_t
NearestPointGrid::blockOf(std::uint64_t key)
{
  const std::size_t slot = slotOf(key);
  if (blocks_[slot].key == key)
    return blocks_[slot].first_cell;
  const std::size_t first = cells_.size();
  blocks_[slot] = {key, first};
  cells_.resize(first + CELLS_A_BLOCK, -1);
  distances_.resize(first + CELLS_A_BLOCK, std::numeric_limits<float>::infinity());
  if (2 * ++used_ > blocks_.size())
    grow();
  return first;
}

void
NearestPointGrid::build(const std::vector<Eigen::Vector3f>& points, float side)
{
  static const std::array<Eigen::Vector3i, CELLS_IN_REACH> reach = cellsInReach();
  side_ = side;
  inverse_side_ = 1 / side;
  used_ = 0;
  blocks_.assign(MIN_SLOTS, Block{});
  cells_.assign(CELLS_A_BLOCK, -1);
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
        cells_[at] = static_cast<int>(i);
      }
    }
  }
}

} // namespace pcl_flashreg
