// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 5: a pose a slot; Call::scores are 0 where it is valid, -1 elsewhere. */
void
hypotheses(const Call& call, cudaStream_t stream);

} // namespace cuda
} // namespace pcl_flashreg
