// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 1, FastFOG: the compatibility graph as a bit matrix, Eq. (dis) and (fog).
//
// A block fills a tile of 128 x 128 pairs and its mirror image; each of its four warps
// fills a strip of 32 rows, as four tiles of 32 x 32. A lane holds four columns in
// registers and goes down the rows, which all lanes read from shared memory: one such read
// serves four tests. A ballot is a row's word of 32 columns, and what a lane saw going
// down is its column's word of 32 rows, which is the mirror image, with no transposition.
//
// N = 7000: N^2 / 2 = 24.5 M tests of about 20 instructions; 6.3 MB written.

#include "cuda/estimation/first_order_graph.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "math/compatibility.h"

namespace pcl_flashreg {
namespace cuda {
namespace {

constexpr unsigned TILE = 128;
constexpr unsigned WARPS = TILE / WARP;
/** \brief Columns of a lane. */
constexpr unsigned COLUMNS = TILE / WARP;

/** \brief A point with the square of its norm. */
__device__ inline float4
withNorm(float x, float y, float z)
{
  return make_float4(x, y, z, fmaf(x, x, fmaf(y, y, z * z)));
}

__device__ inline bool
isEdge(const Call& call,
       const float4& s,
       const float4& t,
       const float4& p,
       const float4& q)
{
  return compatible({s.x, s.y, s.z, t.x, t.y, t.z},
                    {p.x, p.y, p.z, q.x, q.y, q.z},
                    call.length_tolerance,
                    call.min_length_sum);
}

/** \brief The edge test of correspondences (s, t) and (p, q). The filter's products and
 * sums are contracted on purpose: it only decides what is certain. */
template <bool FILTER>
__device__ inline bool
testPair(const Call& call,
         const float4& s,
         const float4& t,
         const float4& p,
         const float4& q)
{
  if (!FILTER)
    return isEdge(call, s, t, p, q);
  const EdgeFilter& f = call.filter;
  const float source_product = fmaf(s.x, p.x, fmaf(s.y, p.y, s.z * p.z));
  const float target_product = fmaf(t.x, q.x, fmaf(t.y, q.y, t.z * q.z));
  const float a = fmaf(-2.0f, source_product, s.w + p.w);
  const float b = fmaf(-2.0f, target_product, t.w + q.w);
  const float difference = a - b;
  const float sum = a + b;
  const float defect =
      fmaf(difference, difference, fmaf(f.minus_two_tau2, sum, f.tau4));
  if (!(defect < f.possible_defect && sum > f.possible_sum))
    return false;
  if (defect < f.sure_defect && sum > f.sure_sum)
    return true;
  return isEdge(call, s, t, p, q);
}

struct Shared {
  float4 source[TILE], target[TILE];
  unsigned mirrored[TILE][WARPS];
};

template <bool FILTER>
__global__ void
__launch_bounds__(TILE) fillTile(const Call call)
{
  const unsigned row_tile = blockIdx.y, column_tile = blockIdx.x;
  if (row_tile > column_tile)
    return; // the mirror image of another block's
  Shared& shared = *reinterpret_cast<Shared*>(sharedMemory());
  const unsigned lane = laneIndex(), warp = warpIndex();
  const unsigned i = row_tile * TILE + threadIdx.x;
  shared.source[threadIdx.x] = withNorm(call.sx[i], call.sy[i], call.sz[i]);
  shared.target[threadIdx.x] = withNorm(call.tx[i], call.ty[i], call.tz[i]);
  float4 source[COLUMNS], target[COLUMNS];
#pragma unroll
  for (unsigned c = 0; c < COLUMNS; ++c) {
    const unsigned j = column_tile * TILE + c * WARP + lane;
    source[c] = withNorm(call.sx[j], call.sy[j], call.sz[j]);
    target[c] = withNorm(call.tx[j], call.ty[j], call.tz[j]);
  }
  __syncthreads();

  unsigned row_words[COLUMNS] = {}, column_words[COLUMNS] = {};
  for (unsigned r = 0; r < WARP; ++r) {
    const float4 s = shared.source[warp * WARP + r];
    const float4 t = shared.target[warp * WARP + r];
#pragma unroll
    for (unsigned c = 0; c < COLUMNS; ++c) {
      const bool edge = testPair<FILTER>(call, s, t, source[c], target[c]);
      const unsigned word = __ballot_sync(ALL_LANES, edge);
      if (lane == r)
        row_words[c] = word;
      column_words[c] |= static_cast<unsigned>(edge) << r;
    }
  }

  const std::size_t row = row_tile * TILE + warp * WARP + lane;
  *reinterpret_cast<uint4*>(call.graph + row * call.words + column_tile * WARPS) =
      make_uint4(row_words[0], row_words[1], row_words[2], row_words[3]);
  if (row_tile == column_tile)
    return;
#pragma unroll
  for (unsigned c = 0; c < COLUMNS; ++c)
    shared.mirrored[c * WARP + lane][warp] = column_words[c];
  __syncthreads();
  const std::size_t column = column_tile * TILE + threadIdx.x;
  const unsigned* words = shared.mirrored[threadIdx.x];
  *reinterpret_cast<uint4*>(call.graph + column * call.words + row_tile * WARPS) =
      make_uint4(words[0], words[1], words[2], words[3]);
}

} // namespace

void
firstOrderGraph(const Call& call, cudaStream_t stream)
{
  const unsigned tiles = call.padded / TILE;
  const Shape shape{dim3(tiles, tiles), dim3(TILE), sizeof(Shared)};
  launch(call.filter.use ? &fillTile<true> : &fillTile<false>, shape, stream, call);
}

void
requireKernelImage()
{
  cudaFuncAttributes attributes;
  PCL_FLASHREG_CUDA(cudaFuncGetAttributes(&attributes, &fillTile<true>));
}

} // namespace cuda
} // namespace pcl_flashreg
