// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "clouds/nearest_point_grid.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

constexpr std::uint64_t FREE = ~std::uint64_t{0};

/** \brief Cells that a point is entered into reach from its own cell to here, squared. */
constexpr int SQUARED_REACH = 5;

/** \brief Cells of a point on a surface, for a first guess of the table's size. */
constexpr std::size_t CELLS_A_POINT = 8;

/** \brief Cells an axis that a key has room for, to either side of the origin. */
constexpr int HALF_RANGE = 1 << 20;

} // namespace

Eigen::Vector3i
NearestPointGrid::cellOf(const Eigen::Vector3f& place) const
{
  // A place far outside ends up in a border cell, where a stray point does no harm.
  constexpr float limit = HALF_RANGE - 4;
  const auto cell = [&](float x) {
    return static_cast<int>(
        std::max(-limit, std::min(limit, std::floor(x * inverse_side_))));
  };
  return {cell(place.x()), cell(place.y()), cell(place.z())};
}

std::uint64_t
NearestPointGrid::keyOf(const Eigen::Vector3i& cell)
{
  const auto part = [](int x) { return static_cast<std::uint64_t>(x + HALF_RANGE); };
  return (part(cell.x()) << 42) | (part(cell.y()) << 21) | part(cell.z());
}

std::size_t
NearestPointGrid::slotOf(std::uint64_t key) const
{
  const std::size_t mask = cells_.size() - 1;
  std::size_t slot = ((key * 0x9E3779B97F4A7C15ull) >> 32) & mask;
  while (cells_[slot].key != FREE && cells_[slot].key != key)
    slot = (slot + 1) & mask;
  return slot;
}

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
