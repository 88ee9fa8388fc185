// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"
#include "math/pose.h"
#include "math/upright.h"
#include "math/weighted_alignment.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief Orthonormal frame of a triangle: x along the first edge, z the normal. */
struct TriangleFrame {
  Vec3 x, y, z;
};

/** \brief The frame of the triangle with edges a and b from one corner.
 * \return false if the corners are collinear or coincident to within 0.6 degrees, or not
 * finite
 */
PCL_FLASHREG_HD inline bool
triangleFrame(const Vec3& a, const Vec3& b, TriangleFrame& frame)
{
  constexpr double MIN_SQUARED_SINE = 1e-4;
  const Vec3 normal = cross(a, b);
  const double squared_area = dot(normal, normal);
  const double squared_a = dot(a, a);
  if (!(squared_area > MIN_SQUARED_SINE * (squared_a * dot(b, b))))
    return false;
  frame.x = (1.0 / sqrt(squared_a)) * a;
  frame.z = (1.0 / sqrt(squared_area)) * normal;
  frame.y = cross(frame.z, frame.x);
  return true;
}

/** \brief Rotation with the columns of `to` times the in-plane rotation by (c, s) times
 * the rows of `from`. */
PCL_FLASHREG_HD inline void
composeFrames(
    const TriangleFrame& from, const TriangleFrame& to, double c, double s, double r[9])
{
  const Vec3 x = c * to.x + s * to.y;
  const Vec3 y = c * to.y - s * to.x;
  const Vec3 to_columns[3] = {x, y, to.z};
  const Vec3 from_rows[3] = {from.x, from.y, from.z};
  for (int i = 0; i < 9; ++i)
    r[i] = 0;
  for (int k = 0; k < 3; ++k) {
    const double column[3] = {to_columns[k].x, to_columns[k].y, to_columns[k].z};
    for (int i = 0; i < 3; ++i) {
      r[3 * i + 0] += column[i] * from_rows[k].x;
      r[3 * i + 1] += column[i] * from_rows[k].y;
      r[3 * i + 2] += column[i] * from_rows[k].z;
    }
  }
}

/** \brief Least-squares rigid alignment of three point pairs, in closed form.
 *
 * Both triangles are planar, so the best rotation takes plane onto plane, and what is
 * left is the best rotation in the plane (2D Procrustes). Taking the normals with the
 * same sign is the optimum as long as the in-plane covariance has a positive determinant;
 * where it has not, the triangle is mirrored (all of it lies within the length
 * tolerance's noise) and flipping the normal fits better: the same formulas, with one
 * axis negated.
 * \return false if a triangle is degenerate, see triangleFrame()
 */
PCL_FLASHREG_HD inline bool
alignTriplet(const Vec3 s[3], const Vec3 t[3], Pose& T_target_source)
{
  TriangleFrame from, to;
  if (!triangleFrame(s[1] - s[0], s[2] - s[0], from) ||
      !triangleFrame(t[1] - t[0], t[2] - t[0], to))
    return false;
  const Vec3 source_mean = (1.0 / 3.0) * (s[0] + s[1] + s[2]);
  const Vec3 target_mean = (1.0 / 3.0) * (t[0] + t[1] + t[2]);

  // Covariance of the in-plane coordinates, target by source.
  double xx = 0, xy = 0, yx = 0, yy = 0;
  for (int i = 0; i < 3; ++i) {
    const Vec3 p = s[i] - source_mean;
    const Vec3 q = t[i] - target_mean;
    const double px = dot(p, from.x), py = dot(p, from.y);
    const double qx = dot(q, to.x), qy = dot(q, to.y);
    xx += qx * px;
    xy += qx * py;
    yx += qy * px;
    yy += qy * py;
  }
  if (xx * yy - xy * yx < 0) {
    // Mirrored: turn the target frame over about its x axis.
    to.y = -1.0 * to.y;
    to.z = -1.0 * to.z;
    yx = -yx;
    yy = -yy;
  }
  const double cosine = xx + yy;
  const double sine = yx - xy;
  const double norm = sqrt(cosine * cosine + sine * sine);
  if (!(norm > 0))
    return false;
  composeFrames(from, to, cosine / norm, sine / norm, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

/** \brief The same of an upright motion: a pose that tilts more than it may is turned back,
 * and to the best heading that it has then. */
PCL_FLASHREG_HD inline bool
alignTriplet(const Vec3 s[3],
             const Vec3 t[3],
             const Upright& upright,
             Pose& T_target_source)
{
  if (!alignTriplet(s, t, T_target_source))
    return false;
  if (!limitTilt(upright, T_target_source.r))
    return true;
  const Vec3 source_mean = (1.0 / 3.0) * (s[0] + s[1] + s[2]);
  const Vec3 target_mean = (1.0 / 3.0) * (t[0] + t[1] + t[2]);
  AlignmentSums sums;
  for (int i = 0; i < 3; ++i)
    sums.add(1, s[i] - source_mean, t[i] - target_mean);
  turnToBestHeading(upright.target_up, sums.products, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

} // namespace pcl_flashreg
