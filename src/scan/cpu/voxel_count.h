// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/point_view.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief How many voxels the middle of a cloud occupies, as a function of their
 * size; the middle is a box that holds the middle 80 % of the points on every axis.
 *
 * All voxel sizes that are a power of two times the finest come out of one sort: points
 * are ordered by the Morton code of their finest voxel, and the highest bit in which
 * two neighbours differ says up to which size they lie in different voxels.
 */
class VoxelCount {
public:
  /** \throws std::invalid_argument if there are fewer than two distinct finite points */
  explicit VoxelCount(const PointView& points);

  /** \brief Points of the middle that differ at the finest voxel size. */
  std::size_t
  distinctPoints() const
  {
    return counts_[0];
  }

  /** \brief Of the middle, along its longest axis. */
  double
  extent() const;

  /** \brief The voxel size at which `count` voxels are occupied, interpolated between
   * powers of two; count in [2, distinctPoints()]. */
  double
  sizeFor(double count) const;

private:
  /** \brief Bits an axis: 2^21 of the finest voxels span the box. */
  static constexpr int LEVELS = 21;

  /** \brief x, y, z of the finite points. */
  using Axes = std::array<std::vector<float>, 3>;

  void
  setBox(const Axes& axes);
  std::vector<std::uint64_t>
  sortedCodes(const Axes& axes) const;

  std::array<double, 3> low_{}, high_{};
  /** \brief Edge of the finest voxel. */
  double finest_ = 0;
  /** \brief Occupied voxels of edge finest_ * 2^level. */
  std::array<std::size_t, LEVELS + 1> counts_{};
};

} // namespace cpu
} // namespace pcl_flashreg
