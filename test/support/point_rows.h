// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_room.h"

#include <pcl_flashreg/point_view.h>

#include <cstdint>
#include <limits>
#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief x, y, z of one point after the other. */
using Points = std::vector<float>;

inline Points
roomPoints(double points_per_square_metre = 400)
{
  const Room room(1, points_per_square_metre, 0.003);
  Points points;
  for (const Eigen::Vector3d& p : room.points())
    for (int axis = 0; axis < 3; ++axis)
      points.push_back(static_cast<float>(p[axis]));
  return points;
}

inline PointView
viewOf(const Points& points)
{
  return {points.data(), points.size() / 3, 3};
}

/** \brief Every third point, once by itself and once named by indices, in rows with other
 * numbers behind the coordinates. */
struct EveryThird {
  Points picked, rows;
  std::vector<std::int32_t> indices;

  explicit EveryThird(const Points& points)
  {
    for (std::size_t i = 0; i < points.size() / 3; ++i) {
      rows.insert(rows.end(), &points[3 * i], &points[3 * i] + 3);
      rows.insert(rows.end(), {7, std::numeric_limits<float>::quiet_NaN()});
      if (i % 3 == 1) {
        picked.insert(picked.end(), &points[3 * i], &points[3 * i] + 3);
        indices.push_back(static_cast<std::int32_t>(i));
      }
    }
  }

  PointView
  view() const
  {
    return {rows.data(), rows.size() / 5, 5, indices.data(), indices.size()};
  }
};

} // namespace made
} // namespace pcl_flashreg
