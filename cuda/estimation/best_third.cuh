// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cuda_runtime.h>

namespace pcl_flashreg {
namespace cuda {

/** \brief The best of what a thread saw, best first, as numbers whose order is score, then
 * smaller vertex; 0 where there is none. Indices are constants, so it lies in registers. */
template <unsigned CAPACITY>
class BestThird {
public:
  __device__ void
  offer(unsigned w, unsigned score)
  {
    unsigned long long key = (static_cast<unsigned long long>(score) << 32) | (~0u - w);
#pragma unroll
    for (unsigned i = 0; i < CAPACITY; ++i)
      if (key > best_[i]) {
        const unsigned long long smaller = best_[i];
        best_[i] = key;
        key = smaller;
      }
  }
  __device__ unsigned long long
  first() const
  {
    return best_[0];
  }
  __device__ void
  dropFirst()
  {
#pragma unroll
    for (unsigned i = 0; i + 1 < CAPACITY; ++i)
      best_[i] = best_[i + 1];
    best_[CAPACITY - 1] = 0;
  }
  __device__ static unsigned
  vertex(unsigned long long key)
  {
    return ~0u - static_cast<unsigned>(key);
  }
  __device__ static unsigned
  score(unsigned long long key)
  {
    return static_cast<unsigned>(key >> 32);
  }

private:
  unsigned long long best_[CAPACITY] = {};
};

} // namespace cuda
} // namespace pcl_flashreg
