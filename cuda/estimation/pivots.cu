// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 3: the K best edges, Eq. (pivot), by a histogram of the integer scores. Whatever
// is above its threshold bucket is taken as it comes and sorted in the end; of the bucket
// itself the first in the order of (u, v), by the number of ties in the rows before.
//
// N = 7000: three launches over 1.1 MB of scores, of which rows without a score at the
// threshold (nineteen in twenty) are passed over, and 2048 keys sorted in one block.

#include "cuda/estimation/pivots.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "cuda/estimation/pivot_selection.cuh"

#include <utility>

namespace pcl_flashreg {
namespace cuda {
namespace {

constexpr unsigned WARPS = 8;
/** \brief Keys that a block sorts, two a thread. */
constexpr unsigned RUN = 2048;
constexpr unsigned SORT_THREADS = RUN / 2;

__global__ void
__launch_bounds__(WARPS* WARP) collectRowsAboveCut(const Call call)
{
  if (planHolds(call))
    collectAboveCut(call, *reinterpret_cast<BlockScratch*>(sharedMemory()));
}

__global__ void
__launch_bounds__(WARPS* WARP) collectRowsTies(const Call call)
{
  if (planHolds(call))
    collectTies(call);
}

/** \brief Sorts runs of RUN keys each, ascending, by Batcher's bitonic network. */
__global__ void
__launch_bounds__(SORT_THREADS) sortRuns(const Call call)
{
  if (!planHolds(call))
    return;
  const unsigned count = call.control->pivots;
  const unsigned begin = blockIdx.x * RUN;
  if (begin >= count)
    return;
  auto* keys = reinterpret_cast<unsigned long long*>(sharedMemory());
  for (unsigned i = threadIdx.x; i < RUN; i += SORT_THREADS)
    keys[i] = begin + i < count ? call.pivot_keys[begin + i] : ~0ull;
  __syncthreads();
  for (unsigned size = 2; size <= RUN; size *= 2)
    for (unsigned distance = size / 2; distance > 0; distance /= 2) {
      // The pair (low, low + distance) of this thread.
      const unsigned low = 2 * threadIdx.x - threadIdx.x % distance;
      const unsigned long long a = keys[low], b = keys[low + distance];
      const bool ascending = (low & size) == 0;
      if ((a > b) == ascending) {
        keys[low] = b;
        keys[low + distance] = a;
      }
      __syncthreads();
    }
  for (unsigned i = threadIdx.x; i < RUN && begin + i < count; i += SORT_THREADS)
    call.pivot_keys[begin + i] = keys[i];
}

/** \brief Number of keys in [begin, end) below this one; all are different. */
__device__ inline unsigned
countBelow(const unsigned long long* keys,
           unsigned begin,
           unsigned end,
           unsigned long long key)
{
  unsigned low = begin, high = end;
  while (low < high) {
    const unsigned middle = low + (high - low) / 2;
    if (keys[middle] < key)
      low = middle + 1;
    else
      high = middle;
  }
  return low - begin;
}

/** \brief Merges neighbouring runs of `run` keys: a key's place is its own plus the number
 * of smaller ones in the other run. */
__global__ void
mergeRuns(const Call call, const unsigned run)
{
  if (!planHolds(call))
    return;
  const unsigned count = call.control->pivots;
  const unsigned i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i >= count)
    return;
  const unsigned pair_begin = i / (2 * run) * (2 * run);
  const unsigned middle = min(count, pair_begin + run);
  const unsigned pair_end = min(count, pair_begin + 2 * run);
  const unsigned long long key = call.pivot_keys[i];
  const unsigned place = i < middle
                             ? i + countBelow(call.pivot_keys, middle, pair_end, key)
                             : i - (middle - pair_begin) +
                                   countBelow(call.pivot_keys, pair_begin, middle, key);
  call.pivot_keys_other[place] = key;
}

} // namespace

void
selectPivots(const Call& call, cudaStream_t stream)
{
  const Shape shape{
      dim3((call.size + WARPS - 1) / WARPS), dim3(WARPS * WARP), sizeof(BlockScratch)};
  launch(&collectRowsAboveCut, shape, stream, call);
  launch(&collectRowsTies, shape, stream, call);
}

void
sortPivots(Call& call, cudaStream_t stream)
{
  const unsigned runs = (call.pivots + RUN - 1) / RUN;
  const Shape sort{dim3(runs), dim3(SORT_THREADS), RUN * sizeof(unsigned long long)};
  launch(&sortRuns, sort, stream, call);
  constexpr unsigned threads = 256;
  const Shape merge{dim3((call.pivots + threads - 1) / threads), dim3(threads), 0};
  for (unsigned run = RUN; run < call.pivots; run *= 2) {
    launch(&mergeRuns, merge, stream, call, run);
    std::swap(call.pivot_keys, call.pivot_keys_other);
  }
}

} // namespace cuda
} // namespace pcl_flashreg
