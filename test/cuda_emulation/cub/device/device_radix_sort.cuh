// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Stands in for CUB's header of this name, in the order of the stream.

#include "cuda_runtime.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace cub {

/** \brief An array, and another one that it can be sorted into. */
template <typename Value>
struct DoubleBuffer {
  Value* d_buffers[2];
  int selector = 0;

  DoubleBuffer(Value* current, Value* alternate) : d_buffers{current, alternate} {}
  Value*
  Current() const
  {
    return d_buffers[selector];
  }
  Value*
  Alternate() const
  {
    return d_buffers[selector ^ 1];
  }
};

struct DeviceRadixSort {
  /** \brief Asks for a byte of scratch, then sorts stably by these bits of the keys, into
   * the other array. */
  template <typename Key, typename Value>
  static cudaError_t
  SortPairsDescending(void* scratch,
                      std::size_t& scratch_bytes,
                      DoubleBuffer<Key>& keys,
                      DoubleBuffer<Value>& values,
                      int items,
                      int begin_bit,
                      int end_bit,
                      cudaStream_t stream)
  {
    if (!scratch) {
      scratch_bytes = 1;
      return cudaSuccess;
    }
    const Key* from_keys = keys.Current();
    const Value* from_values = values.Current();
    Key* to_keys = keys.Alternate();
    Value* to_values = values.Alternate();
    keys.selector ^= 1;
    values.selector ^= 1;
    const Key mask = (~Key{0} >> (8 * sizeof(Key) - end_bit)) >> begin_bit << begin_bit;
    return cuda_emulation::enqueueGrid(stream, 1, 1, 0, false, [=] {
      std::vector<int> order(items);
      std::iota(order.begin(), order.end(), 0);
      std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
        return (from_keys[a] & mask) > (from_keys[b] & mask);
      });
      for (int i = 0; i < items; ++i) {
        to_keys[i] = from_keys[order[i]];
        to_values[i] = from_values[order[i]];
      }
    });
  }
};

} // namespace cub
