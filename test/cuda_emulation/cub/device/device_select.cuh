// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Stands in for CUB's header of this name, in the order of the stream.

#include "cuda_runtime.h"

namespace cub {

struct DeviceSelect {
  /** \brief Asks for a byte of scratch, then keeps what the predicate holds for. */
  template <typename Input, typename Output, typename Count, typename Predicate>
  static cudaError_t
  If(void* scratch,
     std::size_t& scratch_bytes,
     Input input,
     Output* output,
     Count* count,
     int items,
     Predicate predicate,
     cudaStream_t stream)
  {
    if (!scratch) {
      scratch_bytes = 1;
      return cudaSuccess;
    }
    return cuda_emulation::enqueueGrid(stream, 1, 1, 0, false, [=] {
      Count kept = 0;
      for (int i = 0; i < items; ++i)
        if (predicate(input[i]))
          output[kept++] = input[i];
      *count = kept;
    });
  }
};

} // namespace cub
