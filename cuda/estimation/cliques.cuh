// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 4: the T best third vertices of every pivot, into its slots. */
void
cliques(const Call& call, cudaStream_t stream);

} // namespace cuda
} // namespace pcl_flashreg
