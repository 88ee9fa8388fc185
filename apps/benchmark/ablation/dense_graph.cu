// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 1 as a dense matrix, and what goes between that and the project's bit matrix.

#include "dense_graph.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "math/compatibility.h"

namespace pcl_flashreg {
namespace dense {
namespace {

using namespace cuda;

constexpr unsigned THREADS = 256;
/** \brief Entries of a thread. */
constexpr unsigned COLUMNS = 4;

__device__ inline PointPair
pairAt(const Call& call, std::size_t i)
{
  return {call.sx[i], call.sy[i], call.sz[i], call.tx[i], call.ty[i], call.tz[i]};
}

template <typename Value>
__global__ void
__launch_bounds__(THREADS) fillMatrix(const Call call, const Matrix<Value> graph)
{
  const std::size_t i = blockIdx.y;
  const PointPair mine = pairAt(call, i);
#pragma unroll
  for (unsigned c = 0; c < COLUMNS; ++c) {
    const std::size_t j = (blockIdx.x * COLUMNS + c) * THREADS + threadIdx.x;
    if (j < graph.stride) // coordinates between size and stride are NaN
      setEdge(graph.row(i)[j],
              compatible(
                  mine, pairAt(call, j), call.length_tolerance, call.min_length_sum));
  }
}

/** \brief A block a row. */
template <typename Value>
__global__ void
__launch_bounds__(THREADS) unpackRow(const Call call, const Matrix<Value> graph)
{
  const std::size_t i = blockIdx.x;
  const unsigned* bits = call.graph + i * call.words;
  for (std::size_t j = threadIdx.x; j < graph.stride; j += THREADS)
    setEdge(graph.row(i)[j], ((bits[j / WARP] >> (j % WARP)) & 1) != 0);
}

/** \brief A block a row, a warp a word. */
__global__ void
__launch_bounds__(THREADS) packRow(const Call call, const Matrix<float> graph)
{
  const std::size_t i = blockIdx.x;
  for (unsigned w = warpIndex(); w < call.words; w += THREADS / WARP) {
    const std::size_t j = w * WARP + laneIndex();
    const unsigned word =
        __ballot_sync(ALL_LANES, j < graph.stride && isEdge(graph.row(i)[j]));
    if (laneIndex() == 0)
      call.graph[i * call.words + w] = word;
  }
}

} // namespace

template <typename Value>
void
firstOrderGraph(const Call& call, Matrix<Value> graph, cudaStream_t stream)
{
  constexpr unsigned columns = THREADS * COLUMNS;
  const auto blocks = static_cast<unsigned>((graph.stride + columns - 1) / columns);
  const Shape shape{dim3(blocks, call.size), dim3(THREADS), 0};
  launch(&fillMatrix<Value>, shape, stream, call, graph);
}

template <typename Value>
void
toMatrix(const Call& call, Matrix<Value> graph, cudaStream_t stream)
{
  const Shape shape{dim3(call.size), dim3(THREADS), 0};
  launch(&unpackRow<Value>, shape, stream, call, graph);
}

void
toBits(const Call& call, Matrix<float> graph, cudaStream_t stream)
{
  const Shape shape{dim3(call.size), dim3(THREADS), 0};
  launch(&packRow, shape, stream, call, graph);
}

template void
firstOrderGraph(const Call&, Matrix<float>, cudaStream_t);
template void
firstOrderGraph(const Call&, Matrix<Half>, cudaStream_t);
template void
toMatrix(const Call&, Matrix<float>, cudaStream_t);
template void
toMatrix(const Call&, Matrix<Half>, cudaStream_t);

} // namespace dense
} // namespace pcl_flashreg
