// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What stages 6 and 7 ask of a pose and a correspondence.

#include "math/residual.h"

#include <pcl_flashreg/parameters.h>

#include <cuda_runtime.h>

namespace pcl_flashreg {
namespace cuda {

/** \brief The residual test. Its products and sums are contracted on purpose: they only
 * decide what is certain; squaredResidual() decides the rest. */
__device__ inline bool
isInlier(const PoseF& T,
         const ResidualBounds& bounds,
         float inlier_distance,
         const PointPair& c)
{
  const float dx =
      fmaf(T.r[0], c.sx, fmaf(T.r[1], c.sy, fmaf(T.r[2], c.sz, T.t[0] - c.tx)));
  const float dy =
      fmaf(T.r[3], c.sx, fmaf(T.r[4], c.sy, fmaf(T.r[5], c.sz, T.t[1] - c.ty)));
  const float dz =
      fmaf(T.r[6], c.sx, fmaf(T.r[7], c.sy, fmaf(T.r[8], c.sz, T.t[2] - c.tz)));
  const float squared = fmaf(dz, dz, fmaf(dy, dy, dx * dx));
  if (!(squared < bounds.possible))
    return false;
  return squared < bounds.sure ||
         squaredResidual(T, c) < inlier_distance * inlier_distance;
}

/** \brief What an inlier adds to a score. */
template <ScoreMetric METRIC>
__device__ inline long long
scoreOf(const PoseF& T, float inlier_distance, const PointPair& c)
{
  if (METRIC == ScoreMetric::Inliers)
    return SCORE_UNIT;
  const float squared = squaredResidual(T, c);
  return METRIC == ScoreMetric::Mae ? maeScore(squared, inlier_distance)
                                    : mseScore(squared, inlier_distance);
}

} // namespace cuda
} // namespace pcl_flashreg
