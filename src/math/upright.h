// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"
#include "math/pose.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief What upright motions keep to: the angle between the directions of gravity is at
 * most the largest tilt. */
struct Upright {
  /** \brief Whether poses have to. */
  bool required = false;
  /** \brief Unit vectors, in the frame of either side. */
  Vec3 source_up{0, 0, 1}, target_up{0, 0, 1};
  /** \brief Of the largest tilt. */
  double cosine = 1, sine = 0;
  /** \brief The largest tilt moves no vector by more than its length times the root of
   * this. */
  float squared_slope = 0;
};

/** \brief Turns the rotation about a unit vector. */
PCL_FLASHREG_HD inline void
turnAbout(const Vec3& axis, double cosine, double sine, double r[9])
{
  for (int column = 0; column < 3; ++column) {
    const Vec3 v{r[column], r[3 + column], r[6 + column]};
    const double along = (1 - cosine) * dot(axis, v);
    const Vec3 turned = cosine * v + sine * cross(axis, v) + along * axis;
    r[column] = turned.x;
    r[3 + column] = turned.y;
    r[6 + column] = turned.z;
  }
}

/** \brief A unit vector that is perpendicular to this one. */
PCL_FLASHREG_HD inline Vec3
perpendicularTo(const Vec3& v)
{
  const double x = fabs(v.x), y = fabs(v.y), z = fabs(v.z);
  const Vec3 least = x <= y && x <= z ? Vec3{1, 0, 0}
                     : y <= z         ? Vec3{0, 1, 0}
                                      : Vec3{0, 0, 1};
  const Vec3 p = cross(v, least);
  return (1 / sqrt(dot(p, p))) * p;
}

/** \brief The rotation next to this one whose tilt is the largest that there may be; turned
 * over, about an axis that the target's gravity alone determines.
 * \return false if it did not tilt more, and is as it was */
PCL_FLASHREG_HD inline bool
limitTilt(const Upright& upright, double r[9])
{
  if (!upright.required)
    return false;
  const Vec3 up = rotate(r, upright.source_up);
  const double cosine = dot(up, upright.target_up);
  if (!(cosine < upright.cosine))
    return false;
  constexpr double TURNED_OVER = 1e-9;
  const Vec3 across = cross(up, upright.target_up);
  const double sine = sqrt(dot(across, across));
  const Vec3 axis =
      sine < TURNED_OVER ? perpendicularTo(upright.target_up) : (1 / sine) * across;
  // By the tilt, less the largest one.
  const double norm = sqrt(cosine * cosine + sine * sine);
  turnAbout(axis,
            (cosine * upright.cosine + sine * upright.sine) / norm,
            (sine * upright.cosine - cosine * upright.sine) / norm,
            r);
  return true;
}

/** \brief Turns the rotation about the target's gravity, which leaves its tilt, until the
 * points fit best (2D Procrustes).
 * \param[in] products sum of source_a * target_b of the centred points, row-major in
 * (a, b) */
PCL_FLASHREG_HD inline void
turnToBestHeading(const Vec3& target_up, const double products[9], double r[9])
{
  // Sum of (r * source)_i * target_j.
  double m[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      m[i][j] = (r[3 * i] * products[j] + r[3 * i + 1] * products[3 + j]) +
                r[3 * i + 2] * products[6 + j];
  const Vec3 turned{m[1][2] - m[2][1], m[2][0] - m[0][2], m[0][1] - m[1][0]};
  const double up[3] = {target_up.x, target_up.y, target_up.z};
  double upwards = 0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      upwards += up[i] * up[j] * m[i][j];
  const double cosine = (m[0][0] + m[1][1] + m[2][2]) - upwards;
  const double sine = dot(target_up, turned);
  const double norm = sqrt(cosine * cosine + sine * sine);
  if (norm > 0 && norm < HUGE_VAL)
    turnAbout(target_up, cosine / norm, sine / norm, r);
}

} // namespace pcl_flashreg
