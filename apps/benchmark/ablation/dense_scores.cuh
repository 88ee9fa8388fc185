// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"
#include "dense_matrix.cuh"

namespace pcl_flashreg {
namespace dense {

/** \brief Stage 2, Eq. (sog), after the product: scores = products .* graph, in place, in
 * the upper triangle; nobody reads the rest.
 * \param[in,out] positives to which the number of positive scores is added
 */
template <typename Value>
void
maskScores(const cuda::Call& call,
           Matrix<Value> graph,
           Matrix<float> scores,
           unsigned long long* positives,
           cudaStream_t stream);

/** \brief Call::upper, the sparse rows of the bounded form, as such a matrix. */
void
scatterScores(const cuda::Call& call,
              Matrix<float> scores,
              unsigned long long* positives,
              cudaStream_t stream);

} // namespace dense
} // namespace pcl_flashreg
