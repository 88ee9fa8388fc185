// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"

#include <cmath>

namespace pcl_flashreg {

/** \brief A point of a surface with its unit normal. */
struct OrientedPoint {
  float x, y, z;
  float nx, ny, nz;
};

/** \brief Histogram bins, 0 to 10 each, of the three angles between two oriented points. */
struct PairBins {
  int alpha_turn, alpha, phi;
};

/** \brief Directions of the sector boundaries that lie in the upper half plane: angles
 * (2 k + 1) pi / 11, k = 0 ... 4. */
#define PCL_FLASHREG_SECTOR_COSINES                                                    \
  0.959492974f, 0.654860734f, 0.142314838f, -0.415415013f, -0.841253533f
#define PCL_FLASHREG_SECTOR_SINES                                                      \
  0.281732557f, 0.755749574f, 0.989821442f, 0.909631995f, 0.540640817f

/** \brief Angles whose cosines are closer than this are compared as PCL does, as angles in
 * single precision; elsewhere comparing the cosines gives the same. */
constexpr float NEARLY_EQUAL_COSINES = 5e-7f;

/** \brief Inner product, rounded once an operation in the order in which PCL adds up. */
PCL_FLASHREG_HD inline float
pairDot(float ax, float ay, float az, float bx, float by, float bz)
{
  return (ax * bx + az * bz) + ay * by;
}

/** \brief Whether the angle of cosine a is larger than that of b; a, b >= 0. Parallel normals
 * on two levels make the same angle with the line between them, and which of both points
 * is the origin then changes phi: so ties must fall as they do in PCL. */
PCL_FLASHREG_HD inline bool
isLargerAngle(float a, float b)
{
  return fabsf(a - b) < NEARLY_EQUAL_COSINES ? acosf(a) > acosf(b) : a < b;
}

/** \brief Sines of theta smaller than this are rounding errors. */
constexpr float NEARLY_HALF_TURN = 1e-6f;

/** \brief Whether theta is half a turn, pi or -pi by the sign of a rounding error. */
PCL_FLASHREG_HD inline bool
isHalfTurn(float turn_y, float cosine)
{
  return fabsf(turn_y) < NEARLY_HALF_TURN && cosine < 0;
}

/** \brief w . t, rounded as PCL does, which settles the sign of a half turn; v is d x u. */
PCL_FLASHREG_HD inline float
halfTurn(const float v[3], float v_length, const float u[3], const float t[3])
{
  const float x = v[0] / v_length, y = v[1] / v_length, z = v[2] / v_length;
  return pairDot(
      u[1] * z - u[2] * y, u[2] * x - u[0] * z, u[0] * y - u[1] * x, t[0], t[1], t[2]);
}

/** \brief Pair features of Rusu et al., "Fast Point Feature Histograms (FPFH) for 3D
 * Registration" (ICRA 2009), Eq. (1), in the order and binning of PCL's FPFHEstimation:
 * theta = atan2(w . n_t, u . n_t), alpha = v . n_t, phi = u . d / |d|, where u is the normal
 * of the point whose normal makes the smaller angle with the line, v = d x u / |d x u| and
 * w = u x v.
 *
 * The bin of theta is found by comparing with the boundaries' directions, so that no
 * angle, and no scale of (w . n_t, u . n_t), is needed. Every operation is rounded once, in
 * this order: the vector kernels give the same bins to the last one.
 * \return false if the points coincide, or the line runs along the normal, or something
 * is not a number
 */
PCL_FLASHREG_HD inline bool
pairBins(const OrientedPoint& p, const OrientedPoint& q, PairBins& bins)
{
  float dx = q.x - p.x, dy = q.y - p.y, dz = q.z - p.z;
  const float length = sqrtf(pairDot(dx, dy, dz, dx, dy, dz));
  if (!(length > 0))
    return false;
  const float along_p = pairDot(p.nx, p.ny, p.nz, dx, dy, dz) / length;
  const float along_q = pairDot(q.nx, q.ny, q.nz, dx, dy, dz) / length;
  const float cosine = pairDot(p.nx, p.ny, p.nz, q.nx, q.ny, q.nz);
  // The frame's origin is the point whose normal is closer to the line.
  const bool swap = isLargerAngle(fabsf(along_p), fabsf(along_q));
  const float ux = swap ? q.nx : p.nx, uy = swap ? q.ny : p.ny, uz = swap ? q.nz : p.nz;
  const float tx = swap ? p.nx : q.nx, ty = swap ? p.ny : q.ny, tz = swap ? p.nz : q.nz;
  if (swap) {
    dx = -dx;
    dy = -dy;
    dz = -dz;
  }
  const float phi = swap ? -along_q : along_p;
  const float along_t = swap ? -along_p : along_q;
  // v = d x u is left at its length, and so is w: |d x u| w . n_t =
  // |d| (d . n_t - (d . u)(u . n_t)), with the inner products of d those of its direction.
  const float vx = dy * uz - dz * uy;
  const float vy = dz * ux - dx * uz;
  const float vz = dx * uy - dy * ux;
  const float v_length = sqrtf(pairDot(vx, vy, vz, vx, vy, vz));
  float turn_y = along_t - phi * cosine;
  if (isHalfTurn(turn_y, cosine)) {
    const float v[3] = {vx, vy, vz}, u[3] = {ux, uy, uz}, t[3] = {tx, ty, tz};
    turn_y = halfTurn(v, v_length, u, t);
  }
  turn_y *= length;
  const float turn_x = cosine * v_length;
  const float alpha = pairDot(vx, vy, vz, tx, ty, tz) / v_length;
  // A cosine, unless it is not a number.
  if (!(v_length > 0) || !(alpha > -2))
    return false;

  const float cosines[5] = {PCL_FLASHREG_SECTOR_COSINES};
  const float sines[5] = {PCL_FLASHREG_SECTOR_SINES};
  const float upper_y = fabsf(turn_y);
  int sectors = 0;
  for (int k = 0; k < 5; ++k)
    sectors += upper_y * cosines[k] - turn_x * sines[k] > 0 ? 1 : 0;
  bins.alpha_turn = turn_y < 0 ? 5 - sectors : 5 + sectors;
  const float alpha_bin = alpha * 5.5f + 5.5f, phi_bin = phi * 5.5f + 5.5f;
  bins.alpha = static_cast<int>(fminf(fmaxf(alpha_bin, 0.0f), 10.0f));
  bins.phi = static_cast<int>(fminf(fmaxf(phi_bin, 0.0f), 10.0f));
  return true;
}

} // namespace pcl_flashreg
