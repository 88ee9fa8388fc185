// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 4: the T best third vertices of every pivot, Eq. (common) and (clique), Alg. 1
// phase 2; ties go to the smaller vertex.
//
// A warp a pivot: its lanes go through u's row and search v's, each keeps its T best in
// registers, and the warp merges them by T rounds of a maximum. The 2000 pivots of the
// usual call are 2000 warps, all resident at once.

#include "cuda/estimation/cliques.cuh"

#include "cuda/estimation/best_third.cuh"
#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"

namespace pcl_flashreg {
namespace cuda {
namespace {

constexpr unsigned WARPS = 4;

/** \brief Columns of u's row that a lane searches v's row for at a time: a search is a chain of
 * reads, and one chain alone would leave the lane waiting. */
constexpr unsigned AHEAD = 4;

/** \brief Where columns stand in an ascending row, or the row's length where they don't.
 * \param[out] places lower bounds first: every step halves what is open, for all of them */
__device__ inline void
find(const unsigned* columns,
     unsigned length,
     const unsigned (&wanted)[AHEAD],
     unsigned (&places)[AHEAD])
{
#pragma unroll
  for (unsigned k = 0; k < AHEAD; ++k)
    places[k] = 0;
  for (unsigned half = length == 0 ? 0 : 1u << (31 - __clz(static_cast<int>(length)));
       half > 0;
       half /= 2) {
#pragma unroll
    for (unsigned k = 0; k < AHEAD; ++k) {
      const unsigned last = places[k] + half - 1;
      if (last < length && columns[last] < wanted[k])
        places[k] += half;
    }
  }
#pragma unroll
  for (unsigned k = 0; k < AHEAD; ++k)
    if (places[k] < length && columns[places[k]] != wanted[k])
      places[k] = length;
}

template <unsigned CAPACITY>
__global__ void
__launch_bounds__(WARPS* WARP) findCliques(const Call call)
{
  if (!planHolds(call))
    return;
  const unsigned p = blockIdx.x * WARPS + warpIndex();
  if (p >= call.control->pivots)
    return;
  const Edge pivot = Pivot::edge(call.pivot_keys[p]);
  const Row u = call.upper.rows[pivot.u], v = call.upper.rows[pivot.v];
  const unsigned* columns_v = call.upper.columns + v.columns_begin;
  BestThird<CAPACITY> best;
  for (unsigned first = laneIndex(); first < u.length; first += AHEAD * WARP) {
    unsigned columns[AHEAD], places[AHEAD];
#pragma unroll
    for (unsigned k = 0; k < AHEAD; ++k) {
      const unsigned a = first + k * WARP;
      // v's row has nothing up to v, and so not u.
      columns[k] = a < u.length ? call.upper.columns[u.columns_begin + a] : pivot.u;
    }
    find(columns_v, v.length, columns, places);
    // Of the triangle (u, v, w) each corner votes for the opposite edge: in exact mode no
    // score is 0 here, and in bounded mode no row has such an entry.
#pragma unroll
    for (unsigned k = 0; k < AHEAD; ++k)
      if (places[k] < v.length)
        best.offer(columns[k],
                   pivot.score + call.upper.scores[u.scores_begin + first + k * WARP] +
                       call.upper.scores[v.scores_begin + places[k]]);
  }

  const unsigned T = call.cliques_per_pivot;
  unsigned count = 0;
  for (; count < T; ++count) {
    const unsigned long long key = warpMax(best.first());
    if (key == 0)
      break;
    if (best.first() == key)
      best.dropFirst();
    if (laneIndex() == 0)
      call.cliques[static_cast<std::size_t>(p) * T + count] = {
          pivot.u,
          pivot.v,
          BestThird<CAPACITY>::vertex(key),
          BestThird<CAPACITY>::score(key)};
  }
  if (laneIndex() != 0)
    return;
  call.clique_counts[p] = count;
  if (count > 0)
    call.control->any_clique = true;
}

} // namespace

void
cliques(const Call& call, cudaStream_t stream)
{
  const Shape shape{dim3((call.pivots + WARPS - 1) / WARPS), dim3(WARPS * WARP), 0};
  launch(call.cliques_per_pivot <= 2 ? &findCliques<2> : &findCliques<16>,
         shape,
         stream,
         call);
}

} // namespace cuda
} // namespace pcl_flashreg
