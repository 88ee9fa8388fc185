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

/** \brief Makes tie_begin, number of ties a row, into the number of ties in the rows
 * before; one block. */
__device__ inline void
scanTies(const Call& call, BlockScratch& scratch)
{
  const unsigned run = (call.size + blockDim.x - 1) / blockDim.x;
  const unsigned begin = min(call.size, threadIdx.x * run);
  const unsigned end = min(call.size, begin + run);
  unsigned sum = 0;
  for (unsigned u = begin; u < end; ++u)
    sum += call.tie_begin[u];
  unsigned total = 0;
  unsigned before = blockExclusiveScan(sum, scratch, total);
  for (unsigned u = begin; u < end; ++u) {
    const unsigned ties = call.tie_begin[u];
    call.tie_begin[u] = before;
    before += ties;
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
