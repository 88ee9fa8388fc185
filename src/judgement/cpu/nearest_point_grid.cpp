// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/nearest_point_grid.h"

namespace pcl_flashreg {
namespace {

/** \brief Cells that a point is entered into reach from its own cell to here, squared. */
constexpr int SQUARED_REACH = 5;

/** \brief Cells of a point on a surface, for a first guess of the table's size. */
constexpr std::size_t CELLS_A_POINT = 8;

} // namespace

void
NearestPointGrid::resize(std::size_t capacity)
{
  std::vector<Cell> old(capacity, Cell{FREE, -1});
  old.swap(cells_);
  for (const Cell& cell : old)
    if (cell.key != FREE)
      cells_[slotOf(cell.key)] = cell;
}

void
NearestPointGrid::enter(int point,
                        const Eigen::Vector3f& place,
                        const Eigen::Vector3i& cell)
{
  const std::uint64_t key = keyOf(cell);
  Cell& entry = cells_[slotOf(key)];
  if (entry.key == FREE) {
    entry = {key, point};
    if (2 * ++used_ > cells_.size())
      resize(2 * cells_.size());
    return;
  }
  const Eigen::Vector3f centre =
      side_ * (cell.cast<float>() + Eigen::Vector3f::Constant(0.5f));
  if ((place - centre).squaredNorm() < ((*points_)[entry.point] - centre).squaredNorm())
    entry.point = point;
}

void
NearestPointGrid::build(const std::vector<Eigen::Vector3f>& points, float side)
{
  points_ = &points;
  side_ = side;
  inverse_side_ = 1 / side;
  used_ = 0;
  cells_.clear();
  std::size_t capacity = 1024;
  while (capacity < 2 * CELLS_A_POINT * points.size())
    capacity *= 2;
  resize(capacity);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3i own = cellOf(points[i]);
    for (int x = -2; x <= 2; ++x)
      for (int y = -2; y <= 2; ++y)
        for (int z = -2; z <= 2; ++z)
          if (x * x + y * y + z * z <= SQUARED_REACH)
            enter(static_cast<int>(i), points[i], own + Eigen::Vector3i(x, y, z));
  }
}

} // namespace pcl_flashreg
