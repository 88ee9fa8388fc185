// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// The steps of stage 3 that are kernels of their own, or parts of the fused one. Between
// any two of them the whole grid has to be through.

#include "cuda/support/block.cuh"
#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Finds the cut from the histogram, from the best score downwards; one block.
 * \param[in] histogram number of candidates by score; score 0 does not count */
__device__ inline void
findCut(const Call& call, BlockScratch& scratch)
{
  Control& control = *call.control;
  const unsigned wanted = call.pivots;
  unsigned above = 0;
  for (long long top = control.best_score; top >= 1; top -= blockDim.x) {
    const long long score = top - static_cast<long long>(threadIdx.x);
    const unsigned count = score >= 1 ? call.histogram[score] : 0;
    unsigned total = 0;
    const unsigned before = above + blockExclusiveScan(count, scratch, total);
    const bool found = before < wanted && wanted - before <= count;
    if (found) {
      control.cut = {static_cast<unsigned>(score), before, wanted - before};
      control.pivots = wanted;
    }
    if (__syncthreads_or(found))
      return;
    above += total;
  }
  if (threadIdx.x == 0) {
    control.cut = {0, above, 0};
    control.pivots = above;
  }
}

/** \brief Ties of four rows; of those behind the last one none.
 * \param[in] first a multiple of 4 */
__device__ inline uint4
tiesOfFour(const Call& call, unsigned first)
{
  if (first >= call.size)
    return {0, 0, 0, 0};
  uint4 ties = *reinterpret_cast<const uint4*>(call.tie_begin + first);
  ties.y = first + 1 < call.size ? ties.y : 0;
  ties.z = first + 2 < call.size ? ties.z : 0;
  ties.w = first + 3 < call.size ? ties.w : 0;
  return ties;
}

/** \brief Makes tie_begin, number of ties a row, into the number of ties in the rows
 * before; one block, which nobody else waits with: the next rows are on their way while
 * these are added up. */
__device__ inline void
scanTies(const Call& call, BlockScratch& scratch)
{
  const unsigned step = 4 * blockDim.x;
  unsigned before = 0;
  uint4 next = tiesOfFour(call, 4 * threadIdx.x);
  for (unsigned begin = 0; begin < call.size; begin += step) {
    const unsigned first = begin + 4 * threadIdx.x;
    const uint4 ties = next;
    next = tiesOfFour(call, first + step);
    unsigned total = 0;
    uint4 sums;
    sums.x =
        before + blockExclusiveScan(ties.x + ties.y + ties.z + ties.w, scratch, total);
    sums.y = sums.x + ties.x;
    sums.z = sums.y + ties.y;
    sums.w = sums.z + ties.z;
    if (first < call.size)
      *reinterpret_cast<uint4*>(call.tie_begin + first) = sums;
    before += total;
  }
}

/** \brief Writes the pivots above the threshold, in any order, and counts those at it, a
 * warp a row. */
__device__ inline void
collectAboveCut(const Call& call, BlockScratch& scratch)
{
  Control& control = *call.control;
  const Cut cut = control.cut;
  const unsigned lane = laneIndex();
  const unsigned warps = gridDim.x * (blockDim.x / WARP);
  for (unsigned u = blockIdx.x * (blockDim.x / WARP) + warpIndex(); u < call.size;
       u += warps) {
    const unsigned best = call.row_best[u];
    unsigned ties = 0;
    if (best > 0 && best >= cut.threshold) {
      const Row row = call.pool.rows[u];
      for (unsigned first = 0; first < row.length; first += WARP) {
        const unsigned i = first + lane;
        const unsigned score =
            i < row.length ? call.pool.scores[row.scores_begin + i] : 0;
        const bool is_above = score > cut.threshold;
        const unsigned above = __ballot_sync(ALL_LANES, is_above);
        ties += __popc(
            __ballot_sync(ALL_LANES, cut.threshold > 0 && score == cut.threshold));
        if (above == 0)
          continue;
        unsigned begin = 0;
        if (lane == 0)
          begin = atomicAdd(&control.written, static_cast<unsigned>(__popc(above)));
        begin = __shfl_sync(ALL_LANES, begin, 0);
        if (is_above)
          call.pivot_keys[begin + __popc(above & lanesBelow(lane))] =
              Pivot::key(u, call.pool.columns[row.columns_begin + i], score);
      }
    }
    if (lane == 0)
      call.tie_begin[u] = ties;
  }
  if (lastBlock(&control.ties_ticket))
    scanTies(call, scratch);
}

/** \brief Writes the first of the edges at the threshold, a warp a row. */
__device__ inline void
collectTies(const Call& call)
{
  const Cut cut = call.control->cut;
  if (cut.ties == 0)
    return;
  const unsigned lane = laneIndex();
  const unsigned warps = gridDim.x * (blockDim.x / WARP);
  for (unsigned u = blockIdx.x * (blockDim.x / WARP) + warpIndex(); u < call.size;
       u += warps) {
    unsigned before = call.tie_begin[u];
    if (before >= cut.ties || call.row_best[u] < cut.threshold)
      continue;
    const Row row = call.pool.rows[u];
    for (unsigned first = 0; first < row.length && before < cut.ties; first += WARP) {
      const unsigned i = first + lane;
      const bool tied =
          i < row.length && call.pool.scores[row.scores_begin + i] == cut.threshold;
      const unsigned all = __ballot_sync(ALL_LANES, tied);
      const unsigned rank = before + __popc(all & lanesBelow(lane));
      if (tied && rank < cut.ties)
        call.pivot_keys[cut.above + rank] =
            Pivot::key(u, call.pool.columns[row.columns_begin + i], cut.threshold);
      before += __popc(all);
    }
  }
}

} // namespace cuda
} // namespace pcl_flashreg
