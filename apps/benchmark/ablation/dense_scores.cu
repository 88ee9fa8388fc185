// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 2 as a dense matrix: what is left to do after the product of the graph with
// itself, and the project's sparse rows in the same form.

#include "dense_scores.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"

namespace pcl_flashreg {
namespace dense {
namespace {

using namespace cuda;

constexpr unsigned THREADS = 256;

__device__ inline void
addPositives(unsigned count, unsigned long long* positives)
{
  count = warpSum(count);
  if (laneIndex() == 0 && count > 0)
    atomicAdd(positives, static_cast<unsigned long long>(count));
}

/** \brief A block a row. */
template <typename Value>
__global__ void
__launch_bounds__(THREADS) maskRow(const Call call,
                                   const Matrix<Value> graph,
                                   const Matrix<float> scores,
                                   unsigned long long* positives)
{
  const std::size_t u = blockIdx.x;
  unsigned count = 0;
  for (std::size_t v = u / WARP * WARP + threadIdx.x; v < call.size; v += THREADS) {
    if (v <= u)
      continue;
    const float score = isEdge(graph.row(u)[v]) ? scores.row(u)[v] : 0;
    scores.row(u)[v] = score;
    count += score > 0;
  }
  addPositives(count, positives);
}

/** \brief A block a row. */
__global__ void
__launch_bounds__(THREADS) scatterRow(const Call call,
                                      const Matrix<float> scores,
                                      unsigned long long* positives)
{
  const std::size_t u = blockIdx.x;
  const Row row = call.upper.rows[u];
  unsigned count = 0;
  for (unsigned i = threadIdx.x; i < row.length; i += THREADS) {
    const unsigned score = call.upper.scores[row.scores_begin + i];
    scores.row(u)[call.upper.columns[row.columns_begin + i]] =
        static_cast<float>(score);
    count += score > 0;
  }
  addPositives(count, positives);
}

} // namespace

template <typename Value>
void
maskScores(const Call& call,
           Matrix<Value> graph,
           Matrix<float> scores,
           unsigned long long* positives,
           cudaStream_t stream)
{
  const Shape shape{dim3(call.size), dim3(THREADS), 0};
  launch(&maskRow<Value>, shape, stream, call, graph, scores, positives);
}

void
scatterScores(const Call& call,
              Matrix<float> scores,
              unsigned long long* positives,
              cudaStream_t stream)
{
  PCL_FLASHREG_CUDA(cudaMemsetAsync(
      scores.values, 0, call.size * scores.stride * sizeof(float), stream));
  const Shape shape{dim3(call.size), dim3(THREADS), 0};
  launch(&scatterRow, shape, stream, call, scores, positives);
}

template void
maskScores(
    const Call&, Matrix<float>, Matrix<float>, unsigned long long*, cudaStream_t);
template void
maskScores(const Call&, Matrix<Half>, Matrix<float>, unsigned long long*, cudaStream_t);

} // namespace dense
} // namespace pcl_flashreg
