// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "scan/cpu/cell_numbering.h"
#include "support/radix_sort.h"
#include "math/vec3.h"
#include "scan/scan_pipeline.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/point_view.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief pcl::VoxelGrid multiplies by the inverse in single precision; points on the
 * border of two voxels must go where it puts them. */
struct VoxelFloor {
  float inverse_size;

  double
  operator()(float x) const
  {
    // The library's floor is a call where the instruction set has none.
    const float scaled = x * inverse_size;
    if (std::abs(scaled) < 1e9f) {
      const auto truncated = static_cast<std::int32_t>(scaled);
      return truncated - (static_cast<float>(truncated) > scaled ? 1 : 0);
    }
    return std::floor(scaled);
  }
};

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
  /** \brief Position of a voxel that was added. */
  std::size_t
  find(std::uint64_t key) const
  {
    return slots_[slotOf(key)] - 1;
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

  /** \brief After run() on the same points: the sum of the finite normals in each voxel,
   * turned to the same side, in the order of the centroids. */
  std::vector<Vec3>
  sumNormals(const PointView& points, const GivenNormals& normals) const;

  /** \brief After run(): how many points lie in a voxel, by the row of its centroid. */
  std::uint32_t
  countIn(std::size_t row) const
  {
    return table_.voxels()[order_[row].index].count;
  }

private:
  /** \brief Of the last run. */
  std::optional<CellNumbering<VoxelFloor>> numbering_;
  std::vector<VoxelTable> pieces_;
  VoxelTable table_;
  std::vector<KeyedIndex> order_;
};

} // namespace cpu
} // namespace pcl_flashreg
