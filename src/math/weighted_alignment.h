// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"
#include "math/pose.h"
#include "math/symmetric4.h"
#include "math/upright.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief Sums of a weighted alignment problem; add() takes one pair at a time. */
struct AlignmentSums {
  double weight = 0;
  Vec3 source{0, 0, 0};
  Vec3 target{0, 0, 0};
  /** \brief Sum of weight * source_a * target_b, row-major in (a, b). */
  double products[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};

  PCL_FLASHREG_HD void
  add(double w, const Vec3& s, const Vec3& t)
  {
    const Vec3 ws = w * s;
    weight += w;
    source = source + ws;
    target = target + w * t;
    products[0] += ws.x * t.x;
    products[1] += ws.x * t.y;
    products[2] += ws.x * t.z;
    products[3] += ws.y * t.x;
    products[4] += ws.y * t.y;
    products[5] += ws.y * t.z;
    products[6] += ws.z * t.x;
    products[7] += ws.z * t.y;
    products[8] += ws.z * t.z;
  }
};

/** \brief Pairs are dealt out to this many sums in turn, in ascending order; sumLanes()
 * adds those up. So every backend rounds the same way, and a warp finds work for all of
 * its lanes. */
constexpr int ALIGNMENT_LANES = 32;

/** \brief The sum of all lanes, in a fixed order, left in the first: lane i takes in lane
 * i + 16, then i + 8, and so on. */
inline const AlignmentSums&
sumLanes(AlignmentSums lanes[ALIGNMENT_LANES])
{
  for (int distance = ALIGNMENT_LANES / 2; distance > 0; distance /= 2)
    for (int i = 0; i < distance; ++i) {
      AlignmentSums& a = lanes[i];
      const AlignmentSums& b = lanes[i + distance];
      a.weight += b.weight;
      a.source = a.source + b.source;
      a.target = a.target + b.target;
      for (int k = 0; k < 9; ++k)
        a.products[k] += b.products[k];
    }
  return lanes[0];
}

/** \brief Rotation of a unit quaternion (w, x, y, z). */
PCL_FLASHREG_HD inline void
quaternionToRotation(const double q[4], double r[9])
{
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  r[0] = 1 - 2 * (y * y + z * z);
  r[1] = 2 * (x * y - w * z);
  r[2] = 2 * (x * z + w * y);
  r[3] = 2 * (x * y + w * z);
  r[4] = 1 - 2 * (x * x + z * z);
  r[5] = 2 * (y * z - w * x);
  r[6] = 2 * (x * z - w * y);
  r[7] = 2 * (y * z + w * x);
  r[8] = 1 - 2 * (x * x + y * y);
}

/** \brief Weighted least-squares rigid alignment by Horn's quaternion method.
 * \return false if the sums do not determine a rotation: less than three pairs' worth of
 * spread (collinear or coincident points), or not finite
 */
PCL_FLASHREG_HD inline bool
alignWeighted(const AlignmentSums& sums, Pose& T_target_source)
{
  if (!(sums.weight > 0))
    return false;
  const Vec3 source_mean = (1.0 / sums.weight) * sums.source;
  const Vec3 target_mean = (1.0 / sums.weight) * sums.target;
  const double s[3] = {source_mean.x, source_mean.y, source_mean.z};
  const double t[3] = {sums.target.x, sums.target.y, sums.target.z};
  double m[3][3];
  double squared_norm = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      m[a][b] = sums.products[3 * a + b] - s[a] * t[b];
      squared_norm += m[a][b] * m[a][b];
    }
  if (!(squared_norm > 0) || !(squared_norm < HUGE_VAL))
    return false;
  const double scale = 1 / sqrt(squared_norm);
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      m[a][b] *= scale;

  Matrix4 n;
  n.a[0][0] = m[0][0] + m[1][1] + m[2][2];
  n.a[1][1] = m[0][0] - m[1][1] - m[2][2];
  n.a[2][2] = m[1][1] - m[0][0] - m[2][2];
  n.a[3][3] = m[2][2] - m[0][0] - m[1][1];
  n.a[0][1] = n.a[1][0] = m[1][2] - m[2][1];
  n.a[0][2] = n.a[2][0] = m[2][0] - m[0][2];
  n.a[0][3] = n.a[3][0] = m[0][1] - m[1][0];
  n.a[1][2] = n.a[2][1] = m[0][1] + m[1][0];
  n.a[1][3] = n.a[3][1] = m[2][0] + m[0][2];
  n.a[2][3] = n.a[3][2] = m[1][2] + m[2][1];
  n.computeMinors();
  const double determinant = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                             m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  double q[4];
  // A double largest eigenvalue means that a turn about some axis changes nothing.
  if (!largestEigenvector4(n, -8 * determinant, q))
    return false;
  quaternionToRotation(q, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

/** \brief The same of an upright motion: a pose that tilts more than it may is turned back,
 * and to the best heading that it has then. */
PCL_FLASHREG_HD inline bool
alignWeighted(const AlignmentSums& sums, const Upright& upright, Pose& T_target_source)
{
  if (!alignWeighted(sums, T_target_source))
    return false;
  if (!limitTilt(upright, T_target_source.r))
    return true;
  const Vec3 source_mean = (1.0 / sums.weight) * sums.source;
  const Vec3 target_mean = (1.0 / sums.weight) * sums.target;
  AlignmentSums centred = sums;
  centred.add(-1.0, sums.weight * source_mean, target_mean);
  turnToBestHeading(upright.target_up, centred.products, T_target_source.r);
  setTranslation(T_target_source, source_mean, target_mean);
  return true;
}

} // namespace pcl_flashreg
