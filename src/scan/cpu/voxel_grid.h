// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "scan/cpu/cell_numbering.h"
#include "scan/cpu/radix_sort.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/point_view.h>

#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief Sums of the points in a voxel. */
struct VoxelSum {
  std::uint64_t key;
  double x, y, z;
  std::uint32_t count;
};

/** \brief The voxels that were met so far, in the order in which they were. */
class VoxelTable {
public:
  /** \brief Forgets all voxels, keeps the memory. */
  void
  clear();
  void
  add(const VoxelSum& part);
  const std::vector<VoxelSum>&
  voxels() const
  {
    return voxels_;
  }

private:
  void
  grow();
  std::size_t
  slotOf(std::uint64_t key) const;

  std::vector<VoxelSum> voxels_;
  /** \brief Index of a voxel plus 1, or 0; a power of two of slots, at most half full. */
  std::vector<std::uint32_t> slots_;
};

/** \brief One point a voxel, the centroid of those in it, as pcl::VoxelGrid; voxels in
 * the order z, y, x.
 *
 * Points are added up in pieces of fixed length, and the pieces in their order, so that
 * the sums don't depend on who added them up. Memory goes with the occupied voxels, not
 * with the extent.
 */
class VoxelGrid {
public:
  /** \param[in] bounds of the finite points
   * \param[in] voxel_size > 0
   * \param[out] centroids 3 floats a voxel
   * \throws std::invalid_argument see CellNumbering
   */
  void
  run(const PointView& points,
      const Bounds& bounds,
      float voxel_size,
      ThreadPool& pool,
      std::vector<float>& centroids);

private:
  std::vector<VoxelTable> pieces_;
  VoxelTable table_;
  std::vector<KeyedIndex> order_;
};

} // namespace cpu
} // namespace pcl_flashreg
