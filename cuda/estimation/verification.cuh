// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 6: adds to Call::scores what every correspondence speaks for. */
void
verification(const Call& call, cudaStream_t stream);

} // namespace cuda
} // namespace pcl_flashreg
