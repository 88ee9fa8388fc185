// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/cpu/neighbor_grid.h"

#include "scan/cpu/cell_numbering.h"

#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace cpu {
namespace {

constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/** \brief Cells a little wider than the radius: a distance that is rounded down to below
 * the radius must not reach over a whole cell. */
struct CellFloor {
  double inverse_width;

  explicit CellFloor(double radius) : inverse_width(1 / (1.00001 * radius)) {}

  double
  operator()(float x) const
  {
    return std::floor(x * inverse_width);
  }
};

} // namespace

void
NeighborGrid::build(const std::vector<float>& points, double radius)
{
  const std::size_t count = points.size() / 3;
  Bounds bounds;
  for (std::size_t i = 0; i < count; ++i)
    bounds.add(&points[3 * i]);
  order_.resize(count);
  cells_.clear();
  surroundings_.clear();
  capacity_ = 0;
  if (count == 0)
    return;
  const CellNumbering<CellFloor> numbering(
      CellFloor(radius), bounds, count, [&points](std::size_t i) {
        return &points[3 * i];
      });
  for (std::size_t i = 0; i < count; ++i)
    order_[i] = {numbering.key(&points[3 * i]), static_cast<std::uint32_t>(i)};
  radixSort(order_, numbering.bits());
  sortPoints(points);
  findCells();
  findSurroundings(numbering.yStep(), numbering.zStep());
}

void
NeighborGrid::sortPoints(const std::vector<float>& points)
{
  const std::size_t padded = order_.size() + NEIGHBOR_BLOCK;
  for (AlignedBuffer<float>* values : {&x_, &y_, &z_, &nx_, &ny_, &nz_})
    values->resize(padded);
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const float* point = &points[3 * std::size_t{order_[i].index}];
    x_[i] = point[0];
    y_[i] = point[1];
    z_[i] = point[2];
  }
  for (std::size_t i = order_.size(); i < padded; ++i)
    x_[i] = y_[i] = z_[i] = NOT_A_NUMBER;
}

void
NeighborGrid::findCells()
{
  cell_of_.resize(order_.size());
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const auto at = static_cast<std::uint32_t>(i);
    if (cells_.empty() || cells_.back().key != order_[i].key)
      cells_.push_back({order_[i].key, at, at});
    cells_.back().end = at + 1;
    cell_of_[i] = static_cast<std::uint32_t>(cells_.size() - 1);
  }
}

void
NeighborGrid::findSurroundings(std::uint64_t y_step, std::uint64_t z_step)
{
  surroundings_.assign(cells_.size(), Surroundings{});
  for (int row = 0; row < 9; ++row) {
    // What is looked for ascends with the cell, so one walk finds it for all of them.
    // Steps back are steps of the two's complement.
    const std::uint64_t step = z_step * static_cast<std::uint64_t>(row / 3 - 1) +
                               y_step * static_cast<std::uint64_t>(row % 3 - 1);
    std::size_t first = 0;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      const std::uint64_t centre = cells_[c].key + step;
      while (first < cells_.size() && cells_[first].key < centre - 1)
        ++first;
      std::size_t last = first;
      while (last < cells_.size() && cells_[last].key <= centre + 1)
        ++last;
      Surroundings& around = surroundings_[c];
      if (last > first)
        around.runs[around.run_count++] = {cells_[first].begin, cells_[last - 1].end};
    }
  }
  for (const Surroundings& around : surroundings_) {
    std::size_t reachable = 0;
    for (std::size_t r = 0; r < around.run_count; ++r)
      reachable += around.runs[r].end - around.runs[r].begin;
    capacity_ = std::max(capacity_, reachable + NEIGHBOR_BLOCK);
  }
}

SurfaceArrays
NeighborGrid::arrays() const
{
  return {x_.data(), y_.data(), z_.data(), nx_.data(), ny_.data(), nz_.data()};
}

void
NeighborGrid::setNormal(std::size_t i, float nx, float ny, float nz)
{
  nx_[i] = nx;
  ny_[i] = ny;
  nz_[i] = nz;
}

void
NeighborGrid::remove(std::size_t i)
{
  x_[i] = y_[i] = z_[i] = NOT_A_NUMBER;
}

std::size_t
NeighborGrid::collect(const Kernels& kernels,
                      std::size_t i,
                      float squared_radius,
                      std::uint32_t* indices,
                      float* squared_distances) const
{
  const Surroundings& around = surroundings_[cell_of_[i]];
  const float query[3] = {x_[i], y_[i], z_[i]};
  return kernels.collectNeighbors(arrays(),
                                  around.runs.data(),
                                  around.run_count,
                                  query,
                                  squared_radius,
                                  indices,
                                  squared_distances);
}

} // namespace cpu
} // namespace pcl_flashreg
