// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/compatibility.h"
#include "math/host_device.h"

#include <cmath>
#include <cstdint>

namespace pcl_flashreg {

/** \brief T_target_source in single precision, as verification uses it. */
struct PoseF {
  /** \brief Rotation, row-major. */
  float r[9];
  float t[3];
};

/** \brief Squared residual |R s + t - q|^2, rounded once an operation, in this order. */
PCL_FLASHREG_HD inline float
squaredResidual(const PoseF& T, const PointPair& c)
{
  const float dx = (((T.r[0] * c.sx + T.r[1] * c.sy) + T.r[2] * c.sz) + T.t[0]) - c.tx;
  const float dy = (((T.r[3] * c.sx + T.r[4] * c.sy) + T.r[5] * c.sz) + T.t[1]) - c.ty;
  const float dz = (((T.r[6] * c.sx + T.r[7] * c.sy) + T.r[8] * c.sz) + T.t[2]) - c.tz;
  return (dx * dx + dy * dy) + dz * dz;
}

/** \brief What decides most residuals however they are rounded. */
struct ResidualBounds {
  /** \brief An inlier for certain if the squared residual is below `sure`; possibly one if
   * it is below `possible`. */
  float sure, possible;
};

/** \brief Contracted or not, the rounding of a residual's component errs by at most
 * 22 u B in all, B bounding |R s| + |t| + |q|; the norm, by sqrt(3) times that and 4 u of
 * itself.
 * \param[in] radius largest distance of a point from the origin
 */
PCL_FLASHREG_HD inline ResidualBounds
residualBounds(const PoseF& T, float radius, float inlier_distance)
{
  constexpr double UNIT_ROUNDOFF = 1.0 / (1 << 24);
  const double tau = inlier_distance;
  const double bound = 2.0 * radius + fabs(static_cast<double>(T.t[0])) +
                       fabs(static_cast<double>(T.t[1])) +
                       fabs(static_cast<double>(T.t[2]));
  const double error = UNIT_ROUNDOFF * (64 * bound + 8 * tau);
  const double sure = tau > error ? tau - error : 0.0;
  return {static_cast<float>(sure * sure * (1 - 1e-6)),
          static_cast<float>((tau + error) * (tau + error) * (1 + 1e-6))};
}

/** \brief Scores are sums of integers, so that their value does not depend on the order
 * in which threads and lanes add them up: this many units make a whole inlier. */
constexpr std::int64_t SCORE_UNIT = std::int64_t{1} << 20;

/** \brief 1 - d / inlier_distance of an inlier, in units of SCORE_UNIT, rounded down. */
PCL_FLASHREG_HD inline std::int64_t
maeScore(float squared_residual, float inlier_distance)
{
  const float closeness = 1.0f - sqrtf(squared_residual) / inlier_distance;
  return static_cast<std::int64_t>(closeness * static_cast<float>(SCORE_UNIT));
}

/** \brief (1 - d / inlier_distance)^2 of an inlier, in units of SCORE_UNIT, rounded
 * down. */
PCL_FLASHREG_HD inline std::int64_t
mseScore(float squared_residual, float inlier_distance)
{
  const float closeness = 1.0f - sqrtf(squared_residual) / inlier_distance;
  return static_cast<std::int64_t>(closeness * closeness *
                                   static_cast<float>(SCORE_UNIT));
}

} // namespace pcl_flashreg
