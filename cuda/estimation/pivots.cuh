// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 3: the best edges of Call::pool, unordered. */
void
selectPivots(const Call& call, cudaStream_t stream);

/** \brief Stage 3: sorts the pivots. Call::pivot_keys points to them afterwards. */
void
sortPivots(Call& call, cudaStream_t stream);

} // namespace cuda
} // namespace pcl_flashreg
