// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/surface.h"
#include "math/pose.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {

/** \brief Largest displacement between two poses over the corners of a cube of this half
 * side around the centre of the source. */
inline double
displacementOf(const Pose& a, const Pose& b, double half_side)
{
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{corner & 1 ? half_side : -half_side,
                 corner & 2 ? half_side : -half_side,
                 corner & 4 ? half_side : -half_side};
    const Vec3 d = transform(a, p) - transform(b, p);
    largest = std::max(largest, std::sqrt(dot(d, d)));
  }
  return largest;
}

/** \brief Of the cube in the sphere that holds the cloud. */
inline double
halfSideOf(const Surface& cloud)
{
  float squared = 0;
  for (const Eigen::Vector3f& point : cloud.points)
    squared = std::max(squared, point.squaredNorm());
  return std::sqrt(squared / 3.0);
}

} // namespace pcl_flashreg
