// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/point_view.h>

#include <cmath>
#include <cstddef>

namespace pcl_flashreg {

/** \throws std::invalid_argument if the stride or an index is out of range, or the cloud
 * has more than 2^31 - 1 points */
template <typename Scalar>
void
check(const BasicPointView<Scalar>& points);

/** \brief Which point of the whole cloud is the one at a position among those to use. */
template <typename Scalar>
std::size_t
indexOf(const BasicPointView<Scalar>& points, std::size_t i)
{
  return points.indices ? static_cast<std::size_t>(points.indices[i]) : i;
}

/** \brief A point of a view, by its position among those to use. */
template <typename Scalar>
const Scalar*
pointOf(const BasicPointView<Scalar>& points, std::size_t i)
{
  return points.data + indexOf(points, i) * points.stride;
}

/** \brief Number of points of a view to use. */
template <typename Scalar>
std::size_t
countOf(const BasicPointView<Scalar>& points)
{
  return points.indices ? points.index_count : points.size;
}

template <typename Scalar>
bool
isFinite(const Scalar* point)
{
  return std::isfinite(point[0]) && std::isfinite(point[1]) && std::isfinite(point[2]);
}

} // namespace pcl_flashreg
