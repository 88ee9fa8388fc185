// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 1, FastFOG: fills Call::graph. */
void
firstOrderGraph(const Call& call, cudaStream_t stream);

/** \brief Asks for a kernel's attributes, which fails where this program holds no code for
 * the device. \throws BackendError */
void
requireKernelImage();

} // namespace cuda
} // namespace pcl_flashreg
