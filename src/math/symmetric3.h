// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/vec3.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief A symmetric 3x3 matrix. */
struct Symmetric3 {
  double xx, xy, xz, yy, yz, zz;
};

/** \brief The smallest eigenvalue of a positive semi-definite matrix.
 *
 * Newton's method on the characteristic polynomial from 0, which lies below all roots: it
 * climbs to the first one and never beyond, fast where the root is alone (a surface). Basic
 * operations only, so that every processor gives the same value.
 */
PCL_FLASHREG_HD inline double
smallestEigenvalue(const Symmetric3& a)
{
  const double trace = a.xx + a.yy + a.zz;
  const double minors = (a.xx * a.yy - a.xy * a.xy) + (a.xx * a.zz - a.xz * a.xz) +
                        (a.yy * a.zz - a.yz * a.yz);
  const double determinant = a.xx * (a.yy * a.zz - a.yz * a.yz) -
                             a.xy * (a.xy * a.zz - a.yz * a.xz) +
                             a.xz * (a.xy * a.yz - a.yy * a.xz);
  double root = 0;
  for (int round = 0; round < 50; ++round) {
    const double value = ((root - trace) * root + minors) * root - determinant;
    const double slope = (3 * root - 2 * trace) * root + minors;
    if (!(slope > 0) || !(value < 0))
      break;
    const double step = -value / slope;
    root += step;
    if (step <= 1e-15 * trace)
      break;
  }
  return root;
}

/** \brief A unit eigenvector of the smallest eigenvalue; any one where the spread is alike in
 * all directions.
 * \return false if there is no such direction: the matrix is zero, not finite, or that of
 * points on a line
 */
PCL_FLASHREG_HD inline bool
smallestEigenvector(const Symmetric3& a, double eigenvalue, Vec3& direction)
{
  // It is perpendicular to every row of a - eigenvalue * I.
  const Vec3 rows[3] = {{a.xx - eigenvalue, a.xy, a.xz},
                        {a.xy, a.yy - eigenvalue, a.yz},
                        {a.xz, a.yz, a.zz - eigenvalue}};
  const Vec3 candidates[3] = {
      cross(rows[0], rows[1]), cross(rows[0], rows[2]), cross(rows[1], rows[2])};
  Vec3 best = candidates[0];
  for (int k = 1; k < 3; ++k)
    if (dot(candidates[k], candidates[k]) > dot(best, best))
      best = candidates[k];

  Vec3 longest = rows[0];
  for (int k = 1; k < 3; ++k)
    if (dot(rows[k], rows[k]) > dot(longest, longest))
      longest = rows[k];
  const double scale = dot(longest, longest);
  if (!(scale > 0)) {
    // Spread alike in all directions, unless it is not spread at all.
    direction = {0, 0, 1};
    return eigenvalue > 0 && eigenvalue < HUGE_VAL;
  }
  // A line, but for what sums in single precision leave.
  if (!(dot(best, best) > 1e-12 * scale * scale))
    return false;
  const double length = sqrt(dot(best, best));
  if (!(length > 0) || !(length < HUGE_VAL))
    return false;
  direction = (1 / length) * best;
  return true;
}

} // namespace pcl_flashreg
