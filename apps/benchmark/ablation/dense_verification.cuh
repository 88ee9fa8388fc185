// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "call.cuh"
#include "dense_matrix.cuh"

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

/** \brief Stage 6: all residuals, then their sums, into Call::scores.
 * \param[out] residuals squared, a row a slot; unspecified where a slot holds no pose
 */
void
verification(const cuda::Call& call, Matrix<float> residuals, cudaStream_t stream);

} // namespace dense
} // namespace pcl_flashreg
