// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/compatibility.h"
#include "math/host_device.h"

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
