// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 2, both forms: neighbours as lists, as far as there is room, and their
 * number. Skipped where nobody asks for either. */
void
listNeighbours(const Call& call, cudaStream_t stream);

/** \brief Stage 2, exact: Call::upper, the histogram of its scores and the cut of stage
 * 3. */
void
scoreExactly(const Call& call, cudaStream_t stream);

/** \brief Stage 2, bounded (FastSOG): Call::upper as ELLPACK-R rows, Call::pool, the
 * histogram of the pools and the cut of stage 3. */
void
scoreBounded(const Call& call, unsigned multiprocessors, cudaStream_t stream);

/** \brief Stage 2, bounded, and all of stage 3 but the sorting, in one cooperative
 * kernel. */
void
scoreBoundedAndSelect(const Call& call, unsigned multiprocessors, cudaStream_t stream);

} // namespace cuda
} // namespace pcl_flashreg
