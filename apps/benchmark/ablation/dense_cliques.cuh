// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"
#include "dense_matrix.cuh"

namespace pcl_flashreg {
namespace dense {

/** \brief Stage 4: the T best third vertices of every pivot, Eq. (common) and (clique),
 * from a dense matrix of scores, into the pivot's slots. */
void
cliques(const cuda::Call& call, Matrix<float> scores, cudaStream_t stream);

} // namespace dense
} // namespace pcl_flashreg
