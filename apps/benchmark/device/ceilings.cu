// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ceilings.cuh"

#include "cuda/support/launch.cuh"

#include <cmath>

namespace pcl_flashreg {
namespace benchmark {
namespace {

constexpr unsigned THREADS = 256;
/** \brief Independent chains of a thread: enough to hide an operation's latency. */
constexpr unsigned CHAINS = 8;
constexpr unsigned STEPS = 1024;
/** \brief How often all threads together read the buffer. */
constexpr unsigned PASSES = 16;

__global__ void
__launch_bounds__(THREADS) fuse(const float factor, float* result)
{
  const unsigned thread = blockIdx.x * THREADS + threadIdx.x;
  float chains[CHAINS];
#pragma unroll
  for (unsigned c = 0; c < CHAINS; ++c)
    chains[c] = static_cast<float>(thread + c);
#pragma unroll 16
  for (unsigned step = 0; step < STEPS; ++step)
#pragma unroll
    for (unsigned c = 0; c < CHAINS; ++c)
      chains[c] = fmaf(chains[c], factor, 1.0f);
  float sum = 0;
#pragma unroll
  for (unsigned c = 0; c < CHAINS; ++c)
    sum += chains[c];
  result[thread] = sum;
}

__global__ void
__launch_bounds__(THREADS)
    readAll(const uint4* buffer, const unsigned size, float* result)
{
  const unsigned thread = blockIdx.x * THREADS + threadIdx.x;
  const unsigned threads = gridDim.x * THREADS;
  unsigned bits = 0;
  // Each pass begins elsewhere, so that no cache nearer than the shared one has it.
  for (unsigned pass = 0, shift = 0; pass < PASSES; ++pass, shift += size / PASSES)
#pragma unroll 4
    for (unsigned i = thread; i < size; i += threads) {
      const unsigned at = i + shift < size ? i + shift : i + shift - size;
      const uint4 word = buffer[at];
      bits ^= word.x ^ word.y ^ word.z ^ word.w;
    }
  result[thread] = static_cast<float>(bits);
}

} // namespace

std::size_t
resultSize(unsigned blocks)
{
  return std::size_t{blocks} * THREADS;
}

double
runArithmetic(unsigned blocks, float* result, cudaStream_t stream)
{
  cuda::launch(&fuse, {dim3(blocks), dim3(THREADS), 0}, stream, 0.5f, result);
  return static_cast<double>(blocks) * THREADS * CHAINS * STEPS;
}

double
runReads(unsigned blocks,
         const uint4* buffer,
         std::size_t size,
         float* result,
         cudaStream_t stream)
{
  cuda::launch(&readAll,
               {dim3(blocks), dim3(THREADS), 0},
               stream,
               buffer,
               static_cast<unsigned>(size),
               result);
  return static_cast<double>(size) * sizeof(uint4) * PASSES;
}

} // namespace benchmark
} // namespace pcl_flashreg
