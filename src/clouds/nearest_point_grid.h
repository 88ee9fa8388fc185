// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief Which point of a cloud is near a place, by one look-up.
 *
 * A hash of cubic cells; every point is entered into its own cell and into those around
 * it, and a cell keeps the point nearest to its centre. So the answer is the nearest point
 * to within about the side of a cell, and there is one for every place within 1.4 sides
 * of a point.
 */
class NearestPointGrid {
public:
  /** \param[in] points finite; the caller keeps them
   * \param[in] side of a cell, > 0 */
  void
  build(const std::vector<Eigen::Vector3f>& points, float side);

  /** \return number of a point, -1 if there is none near */
  int
  find(const Eigen::Vector3f& place) const
  {
    return cells_[slotOf(keyOf(cellOf(place)))].point;
  }

private:
  struct Cell {
    std::uint64_t key;
    int point;
  };

  Eigen::Vector3i
  cellOf(const Eigen::Vector3f& place) const;
  static std::uint64_t
  keyOf(const Eigen::Vector3i& cell);
  /** \brief Where the key stands, or would have to be put. */
  std::size_t
  slotOf(std::uint64_t key) const;
  void
  resize(std::size_t capacity);
  void
  enter(int point, const Eigen::Vector3f& place, const Eigen::Vector3i& cell);

  const std::vector<Eigen::Vector3f>* points_ = nullptr;
  float side_ = 1, inverse_side_ = 1;
  std::vector<Cell> cells_;
  std::size_t used_ = 0;
};

} // namespace pcl_flashreg
