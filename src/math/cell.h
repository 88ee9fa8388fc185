// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <cstdint>

namespace pcl_flashreg {

/** \brief Numbers of a cubic cell, along the axes from the origin on. */
using Cell = std::array<std::int64_t, 3>;

/** \param[in] point finite
 * \param[in] side of a cell, > 0 */
inline Cell
cellOf(const Eigen::Vector3f& point, float side)
{
  const auto number = [&](float x) {
    return static_cast<std::int64_t>(std::floor(x / side));
  };
  return {number(point.x()), number(point.y()), number(point.z())};
}

/** \brief Calls visit(cell) for all cells at most `reach` away along every axis. */
template <typename Visit>
void
forEachAround(const Cell& cell, int reach, const Visit& visit)
{
  for (int x = -reach; x <= reach; ++x)
    for (int y = -reach; y <= reach; ++y)
      for (int z = -reach; z <= reach; ++z)
        visit(Cell{cell[0] + x, cell[1] + y, cell[2] + z});
}

} // namespace pcl_flashreg
