// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 4 on a dense matrix: a block a pivot goes through both rows from end to end.

#include "dense_cliques.cuh"

#include "cuda/estimation/best_third.cuh"
#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"

namespace pcl_flashreg {
namespace dense {
namespace {

using namespace cuda;

constexpr unsigned THREADS = 128;

template <unsigned CAPACITY>
__global__ void
__launch_bounds__(THREADS) scanRows(const Call call, const Matrix<float> scores)
{
  const unsigned p = blockIdx.x;
  if (p >= call.control->pivots)
    return;
  BlockScratch& scratch = *reinterpret_cast<BlockScratch*>(sharedMemory());
  const Edge pivot = Pivot::edge(call.pivot_keys[p]);
  const float *row_u = scores.row(pivot.u), *row_v = scores.row(pivot.v);
  BestThird<CAPACITY> best;
  for (unsigned w = pivot.v / WARP * WARP + threadIdx.x; w < call.size; w += THREADS) {
    if (w <= pivot.v)
      continue;
    const float uw = row_u[w], vw = row_v[w];
    if (uw > 0 && vw > 0)
      best.offer(w,
                 pivot.score + static_cast<unsigned>(uw) + static_cast<unsigned>(vw));
  }

  const unsigned T = call.cliques_per_pivot;
  unsigned count = 0;
  for (; count < T; ++count) {
    const unsigned long long key = blockMax(best.first(), scratch);
    if (key == 0)
      break;
    if (best.first() != key)
      continue;
    best.dropFirst();
    call.cliques[std::size_t{p} * T + count] = {pivot.u,
                                                pivot.v,
                                                BestThird<CAPACITY>::vertex(key),
                                                BestThird<CAPACITY>::score(key)};
  }
  if (threadIdx.x != 0)
    return;
  call.clique_counts[p] = count;
  if (count > 0)
    call.control->any_clique = true;
}

} // namespace

void
cliques(const Call& call, Matrix<float> scores, cudaStream_t stream)
{
  const Shape shape{dim3(call.pivots), dim3(THREADS), sizeof(BlockScratch)};
  launch(call.cliques_per_pivot <= 2 ? &scanRows<2> : &scanRows<16>,
         shape,
         stream,
         call,
         scores);
}

} // namespace dense
} // namespace pcl_flashreg
