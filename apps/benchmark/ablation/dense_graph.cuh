// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"
#include "dense_matrix.cuh"

namespace pcl_flashreg {
namespace dense {

/** \brief Stage 1: the first-order graph as a matrix of 0 and 1, Eq. (dis) and (fog), the
 * columns between size and stride included. */
template <typename Value>
void
firstOrderGraph(const cuda::Call& call, Matrix<Value> graph, cudaStream_t stream);

/** \brief Call::graph as a matrix. */
template <typename Value>
void
toMatrix(const cuda::Call& call, Matrix<Value> graph, cudaStream_t stream);

/** \brief A matrix as Call::graph, rows below size. */
void
toBits(const cuda::Call& call, Matrix<float> graph, cudaStream_t stream);

} // namespace dense
} // namespace pcl_flashreg
