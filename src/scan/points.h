// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/point_view.h>

#include <cmath>
#include <cstddef>

namespace pcl_flashreg {

/** \throws std::invalid_argument if the stride or an index is out of range, or the cloud
 * has more than 2^31 - 1 points */
void
check(const PointView& points);

/** \brief A point of a view, by its position among those to use. */
inline const float*
pointOf(const PointView& points, std::size_t i)
{
  const auto at = points.indices ? static_cast<std::size_t>(points.indices[i]) : i;
  return points.data + at * points.stride;
}

/** \brief Number of points of a view to use. */
inline std::size_t
countOf(const PointView& points)
{
  return points.indices ? points.index_count : points.size;
}

inline bool
isFinite(const float* point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

} // namespace pcl_flashreg
