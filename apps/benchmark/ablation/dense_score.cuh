// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/residual.h"

#include <pcl_flashreg/parameters.h>

#include <cuda_runtime.h>

namespace pcl_flashreg {
namespace dense {

/** \brief What a residual adds to the score of a pose. */
__device__ inline long long
scoreOf(ScoreMetric metric, float squared_residual, float inlier_distance)
{
  if (!(squared_residual < inlier_distance * inlier_distance))
    return 0;
  switch (metric) {
  case ScoreMetric::Mae:
    return maeScore(squared_residual, inlier_distance);
  case ScoreMetric::Mse:
    return mseScore(squared_residual, inlier_distance);
  case ScoreMetric::Inliers:
    break;
  }
  return SCORE_UNIT;
}

} // namespace dense
} // namespace pcl_flashreg
