// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the threads of a warp and of a block do together.

#include <cuda_runtime.h>

#include <cstdint>

namespace pcl_flashreg {
namespace cuda {

constexpr unsigned WARP = 32;
constexpr unsigned ALL_LANES = 0xFFFFFFFFu;

/** \brief The block's dynamic shared memory, as the kernel lays it out. */
__device__ inline unsigned char*
sharedMemory()
{
#if defined(__CUDACC__)
  extern __shared__ __align__(16) unsigned char pcl_flashreg_shared_memory[];
  return pcl_flashreg_shared_memory;
#else
  return cuda_emulation::place().shared;
#endif
}

__device__ inline unsigned
laneIndex()
{
  return threadIdx.x % WARP;
}
__device__ inline unsigned
warpIndex()
{
  return threadIdx.x / WARP;
}

/** \brief The lanes before this one. */
__device__ inline unsigned
lanesBelow(unsigned lane)
{
  return (1u << lane) - 1u;
}

/** \brief Sum over the warp, to every lane. */
__device__ inline unsigned
warpSum(unsigned value)
{
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ < 800
  for (unsigned distance = WARP / 2; distance > 0; distance /= 2)
    value += __shfl_xor_sync(ALL_LANES, value, distance);
  return value;
#else
  return __reduce_add_sync(ALL_LANES, value);
#endif
}

/** \brief Largest value of the warp, to every lane. */
__device__ inline unsigned long long
warpMax(unsigned long long value)
{
  for (unsigned distance = WARP / 2; distance > 0; distance /= 2) {
    const unsigned long long other = __shfl_xor_sync(ALL_LANES, value, distance);
    value = other > value ? other : value;
  }
  return value;
}

/** \brief Sum over this lane and those before it. */
__device__ inline unsigned
warpInclusiveScan(unsigned value)
{
  const unsigned lane = laneIndex();
  for (unsigned distance = 1; distance < WARP; distance *= 2) {
    const unsigned below = __shfl_up_sync(ALL_LANES, value, distance);
    if (lane >= distance)
      value += below;
  }
  return value;
}

/** \brief Scratch of the functions below, one a block. */
struct BlockScratch {
  unsigned sums[WARP];
  unsigned long long maxima[WARP];
};

/** \brief Sum over the threads before this one; all threads of the block call it.
 * \param[out] total sum over all threads */
__device__ inline unsigned
blockExclusiveScan(unsigned value, BlockScratch& scratch, unsigned& total)
{
  const unsigned warps = blockDim.x / WARP;
  const unsigned inclusive = warpInclusiveScan(value);
  if (laneIndex() == WARP - 1)
    scratch.sums[warpIndex()] = inclusive;
  __syncthreads();
  if (warpIndex() == 0) {
    const unsigned sum = laneIndex() < warps ? scratch.sums[laneIndex()] : 0;
    const unsigned scanned = warpInclusiveScan(sum);
    __syncwarp();
    scratch.sums[laneIndex()] = scanned;
  }
  __syncthreads();
  total = scratch.sums[warps - 1];
  const unsigned before = warpIndex() > 0 ? scratch.sums[warpIndex() - 1] : 0;
  __syncthreads(); // the scratch may be used again
  return before + inclusive - value;
}

/** \brief Largest value of the block, to every thread; all threads call it. */
__device__ inline unsigned long long
blockMax(unsigned long long value, BlockScratch& scratch)
{
  value = warpMax(value);
  if (laneIndex() == 0)
    scratch.maxima[warpIndex()] = value;
  __syncthreads();
  value = laneIndex() < blockDim.x / WARP ? scratch.maxima[laneIndex()] : 0;
  __syncthreads();
  return warpMax(value);
}

/** \brief Whether this block is the last of the grid to come here; it then sees what the
 * others wrote before. All threads call it.
 * \param[in,out] ticket zero before the launch */
__device__ inline bool
lastBlock(unsigned* ticket)
{
  __threadfence();
  __syncthreads();
  bool last = false;
  if (threadIdx.x == 0)
    last = atomicAdd(ticket, 1u) == gridDim.x * gridDim.y - 1;
  last = __syncthreads_or(last) != 0;
  __threadfence();
  return last;
}

} // namespace cuda
} // namespace pcl_flashreg
