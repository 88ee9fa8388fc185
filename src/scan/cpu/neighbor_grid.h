// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/aligned_buffer.h"
#include "support/radix_sort.h"
#include "simd/kernels.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief Points sorted by the cell of a uniform grid that they lie in.
 *
 * Cells are as wide as the largest radius, so that whatever is in reach of a point lies in
 * its cell's 3 x 3 x 3 surroundings; and since cells that follow each other in x also follow
 * each other in memory, those are nine runs of consecutive points, found once a cell.
 */
class NeighborGrid {
public:
  /** \param[in] points n x 3, finite
   * \param[in] radius the largest that will be asked for, > 0
   * \throws std::invalid_argument see CellNumbering
   */
  void
  build(const std::vector<float>& points, double radius);

  std::size_t
  size() const
  {
    return order_.size();
  }

  /** \brief Which row of the points the sorted point i is. */
  std::uint32_t
  row(std::size_t i) const
  {
    return order_[i].index;
  }

  /** \brief Points, and normals once setNormal() was called for all. */
  SurfaceArrays
  arrays() const;

  void
  setNormal(std::size_t i, float nx, float ny, float nz);

  /** \brief Makes a point nobody's neighbour. */
  void
  remove(std::size_t i);

  bool
  isRemoved(std::size_t i) const
  {
    return !(x_[i] == x_[i]);
  }

  /** \brief Room that the neighbours of any one point need at most. */
  std::size_t
  capacity() const
  {
    return capacity_;
  }

  /** \brief Points within a distance of the sorted point i, itself among them.
   * \param[in] squared_radius at most the square of that of build()
   * \param[out] indices, squared_distances capacity() entries
   * \return how many there are
   */
  std::size_t
  collect(const Kernels& kernels,
          std::size_t i,
          float squared_radius,
          std::uint32_t* indices,
          float* squared_distances) const;

private:
  struct Cell {
    std::uint64_t key;
    std::uint32_t begin, end;
  };
  struct Surroundings {
    std::uint32_t run_count;
    std::array<PointRun, 9> runs;
  };

  void
  sortPoints(const std::vector<float>& points);
  void
  findCells();
  void
  findSurroundings(std::uint64_t y_step, std::uint64_t z_step);

  std::vector<KeyedIndex> order_;
  std::vector<Cell> cells_;
  std::vector<Surroundings> surroundings_;
  /** \brief Of every sorted point. */
  std::vector<std::uint32_t> cell_of_;
  AlignedBuffer<float> x_, y_, z_, nx_, ny_, nz_;
  std::size_t capacity_ = 0;
};

} // namespace cpu
} // namespace pcl_flashreg
