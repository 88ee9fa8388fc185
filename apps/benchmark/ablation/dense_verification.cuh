// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"
#include "dense_matrix.cuh"

namespace pcl_flashreg {
namespace dense {

/** \brief Stage 6: all residuals, then their sums, into Call::scores.
 * \param[out] residuals squared, a row a slot; unspecified where a slot holds no pose
 */
void
verification(const cuda::Call& call, Matrix<float> residuals, cudaStream_t stream);

} // namespace dense
} // namespace pcl_flashreg
