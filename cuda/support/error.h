// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cuda_runtime.h>

namespace pcl_flashreg {
namespace cuda {

/** \brief Throws BackendError with what CUDA says and where the call stands. */
[[noreturn]] void
fail(cudaError_t error, const char* call, const char* file, int line);

} // namespace cuda
} // namespace pcl_flashreg

/** \brief Every call of the CUDA runtime goes through this. */
#define PCL_FLASHREG_CUDA(call)                                                        \
  do {                                                                                 \
    const cudaError_t pcl_flashreg_error = (call);                                     \
    if (pcl_flashreg_error != cudaSuccess)                                             \
      ::pcl_flashreg::cuda::fail(pcl_flashreg_error, #call, __FILE__, __LINE__);       \
  } while (false)
