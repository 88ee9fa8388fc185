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

/** \brief A correspondence; its rise is that of upright motions alone. */
struct Corner {
  float4 source, target;
  float rise;
};

template <bool UPRIGHT>
__device__ inline Corner
cornerOf(const Call& call, unsigned i)
{
  return {withNorm(call.sx[i], call.sy[i], call.sz[i]),
          withNorm(call.tx[i], call.ty[i], call.tz[i]),
          UPRIGHT ? call.rise[i] : 0.0f};
}

template <bool UPRIGHT>
__device__ inline bool
isEdge(const Call& call, const Corner& a, const Corner& b)
{
  const float4 &s = a.source, &t = a.target, &p = b.source, &q = b.target;
  const PointPair mine{s.x, s.y, s.z, t.x, t.y, t.z};
  const PointPair other{p.x, p.y, p.z, q.x, q.y, q.z};
  return compatible(mine, other, call.length_tolerance, call.min_length_sum) &&
         (!UPRIGHT || keepsHeight(mine,
                                  other,
                                  a.rise,
                                  b.rise,
                                  call.length_tolerance,
                                  call.upright.squared_slope));
}

/** \brief The edge test. The filter's products and sums are contracted on purpose: it only
 * decides what is certain. */
template <bool FILTER, bool UPRIGHT>
__device__ inline bool
testPair(const Call& call, const Corner& first, const Corner& second)
{
  if (!FILTER)
    return isEdge<UPRIGHT>(call, first, second);
  const float4 &s = first.source, &t = first.target;
  const float4 &p = second.source, &q = second.target;
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
  bool sure = defect < f.sure_defect && sum > f.sure_sum;
  if (UPRIGHT) {
    const float excess = fabsf(first.rise - second.rise) - call.length_tolerance;
    const float height = fmaf(excess, fabsf(excess), -call.upright.squared_slope * a);
    if (!(height < call.height_margin))
      return false;
    sure = sure && height < -call.height_margin;
  }
  return sure || isEdge<UPRIGHT>(call, first, second);
}

struct Shared {
  float4 source[TILE], target[TILE];
  float rise[TILE];
  unsigned mirrored[TILE][WARPS];
};

template <bool FILTER, bool UPRIGHT>
__global__ void
__launch_bounds__(TILE) fillTile(const Call call)
{
  const unsigned row_tile = blockIdx.y, column_tile = blockIdx.x;
  if (row_tile > column_tile)
    return; // the mirror image of another block's
  Shared& shared = *reinterpret_cast<Shared*>(sharedMemory());
  const unsigned lane = laneIndex(), warp = warpIndex();
  const Corner mine = cornerOf<UPRIGHT>(call, row_tile * TILE + threadIdx.x);
  shared.source[threadIdx.x] = mine.source;
  shared.target[threadIdx.x] = mine.target;
  if (UPRIGHT)
    shared.rise[threadIdx.x] = mine.rise;
  Corner columns[COLUMNS];
#pragma unroll
  for (unsigned c = 0; c < COLUMNS; ++c)
    columns[c] = cornerOf<UPRIGHT>(call, column_tile * TILE + c * WARP + lane);
  __syncthreads();

  unsigned row_words[COLUMNS] = {}, column_words[COLUMNS] = {};
  for (unsigned r = 0; r < WARP; ++r) {
    const unsigned k = warp * WARP + r;
    const Corner corner{
        shared.source[k], shared.target[k], UPRIGHT ? shared.rise[k] : 0.0f};
#pragma unroll
    for (unsigned c = 0; c < COLUMNS; ++c) {
      const bool edge = testPair<FILTER, UPRIGHT>(call, corner, columns[c]);
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
  if (call.upright.required)
    launch(call.filter.use ? &fillTile<true, true> : &fillTile<false, true>,
           shape,
           stream,
           call);
  else
    launch(call.filter.use ? &fillTile<true, false> : &fillTile<false, false>,
           shape,
           stream,
           call);
}

void
requireKernelImage()
{
  cudaFuncAttributes attributes;
  PCL_FLASHREG_CUDA(cudaFuncGetAttributes(&attributes, &fillTile<true, false>));
}

} // namespace cuda
} // namespace pcl_flashreg
