// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The emulated device itself: that it computes what a device would, and that it notices
// the mistakes that it is there for.

#include "emulation.h"
#include "cuda/support/launch.cuh"
#include "cuda/support/memory.h"
#include "cuda/support/stream.h"
#include "cuda/support/block.cuh"

#include <cooperative_groups.h>
#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace pcl_flashreg {
namespace cuda {
namespace {

using cuda_emulation::Order;

constexpr unsigned THREADS = 64;

class CudaEmulation : public testing::Test {
protected:
  void
  SetUp() override
  {
    cuda_emulation::reset();
    values_.reserve(VALUES);
    host_.reserve(VALUES);
  }

  /** \brief Runs a kernel on VALUES numbers 0, 1, 2 ... and returns what became of them. */
  std::vector<unsigned>
  run(void (*kernel)(unsigned*), const Shape& shape, bool cooperative = false)
  {
    std::iota(host_.data(), host_.data() + VALUES, 0u);
    const std::size_t bytes = VALUES * sizeof(unsigned);
    PCL_FLASHREG_CUDA(cudaMemcpyAsync(
        values_.data(), host_.data(), bytes, cudaMemcpyHostToDevice, stream_.get()));
    if (cooperative)
      launchCooperative(kernel, shape, stream_.get(), values_.data());
    else
      launch(kernel, shape, stream_.get(), values_.data());
    PCL_FLASHREG_CUDA(cudaMemcpyAsync(
        host_.data(), values_.data(), bytes, cudaMemcpyDeviceToHost, stream_.get()));
    stream_.synchronize();
    return {host_.data(), host_.data() + VALUES};
  }

  /** \brief The results of all orders of threads. */
  std::vector<std::vector<unsigned>>
  runInAllOrders(void (*kernel)(unsigned*), const Shape& shape)
  {
    std::vector<std::vector<unsigned>> results;
    for (const Order order : {Order::Forward, Order::Reversed, Order::Random}) {
      cuda_emulation::device().order = order;
      results.push_back(run(kernel, shape));
    }
    return results;
  }

  static constexpr std::size_t VALUES = 2 * THREADS;
  Stream stream_;
  DeviceBuffer<unsigned> values_;
  PinnedBuffer<unsigned> host_;
};

const Shape TWO_BLOCKS{dim3(2), dim3(THREADS), THREADS * sizeof(unsigned)};

/** \brief Reverses the numbers of a block through shared memory. */
template <bool WITH_BARRIER>
void
reverse(unsigned* values)
{
  auto* shared = reinterpret_cast<unsigned*>(sharedMemory());
  unsigned& mine = values[blockIdx.x * THREADS + threadIdx.x];
  shared[threadIdx.x] = mine;
  if (WITH_BARRIER)
    __syncthreads();
  mine = shared[THREADS - 1 - threadIdx.x];
}

TEST_F(CudaEmulation, BarriersSeparateWritesFromReads)
{
  for (const auto& result : runInAllOrders(&reverse<true>, TWO_BLOCKS))
    for (unsigned i = 0; i < VALUES; ++i)
      EXPECT_EQ(result[i], i / THREADS * THREADS + THREADS - 1 - i % THREADS);
}

TEST_F(CudaEmulation, MissingBarrierShows)
{
  const auto results = runInAllOrders(&reverse<false>, TWO_BLOCKS);
  EXPECT_NE(results[0], results[1]);
  EXPECT_NE(results[0], results[2]);
}

/** \brief Passes numbers from warp to warp, twice, through the same shared memory. */
template <bool WITH_BARRIER>
void
passOnTwice(unsigned* values)
{
  auto* shared = reinterpret_cast<unsigned*>(sharedMemory());
  unsigned mine = values[blockIdx.x * THREADS + threadIdx.x];
  for (int round = 0; round < 2; ++round) {
    shared[threadIdx.x] = mine;
    __syncthreads();
    mine = 3 * shared[(threadIdx.x + WARP) % THREADS] + 1;
    if (WITH_BARRIER)
      __syncthreads();
  }
  values[blockIdx.x * THREADS + threadIdx.x] = mine;
}

TEST_F(CudaEmulation, MissingBarrierBeforeReuseShows)
{
  const auto good = runInAllOrders(&passOnTwice<true>, TWO_BLOCKS);
  EXPECT_EQ(good[0], good[1]);
  EXPECT_EQ(good[0], good[2]);
  const auto bad = runInAllOrders(&passOnTwice<false>, TWO_BLOCKS);
  EXPECT_NE(bad[0], good[0]);
  EXPECT_NE(bad[1], good[0]);
}

/** \brief Passes numbers on through shared memory within warps. */
template <bool WITH_BARRIER>
void
reverseInWarp(unsigned* values)
{
  auto* shared = reinterpret_cast<unsigned*>(sharedMemory());
  unsigned& mine = values[blockIdx.x * THREADS + threadIdx.x];
  shared[threadIdx.x] = mine;
  if (WITH_BARRIER)
    __syncwarp();
  mine = shared[threadIdx.x ^ (WARP - 1)];
}

TEST_F(CudaEmulation, MissingWarpBarrierShows)
{
  const auto good = runInAllOrders(&reverseInWarp<true>, TWO_BLOCKS);
  EXPECT_EQ(good[0], good[1]);
  EXPECT_EQ(good[0], good[2]);
  const auto bad = runInAllOrders(&reverseInWarp<false>, TWO_BLOCKS);
  EXPECT_NE(bad[0], bad[1]);
}

void
barrierForHalf(unsigned*)
{
  if (threadIdx.x < THREADS / 2)
    __syncthreads();
}

TEST_F(CudaEmulation, BarrierThatNotAllReachIsAnError)
{
  EXPECT_THROW(run(&barrierForHalf, TWO_BLOCKS), BackendError);
  EXPECT_NE(cuda_emulation::lastFailure().find("barrier"), std::string::npos);
}

void
ballotOfHalf(unsigned* values)
{
  if (threadIdx.x % 2 == 0)
    values[threadIdx.x] = __ballot_sync(ALL_LANES, true);
}

TEST_F(CudaEmulation, ExchangeThatNotAllLanesReachIsAnError)
{
  EXPECT_THROW(run(&ballotOfHalf, TWO_BLOCKS), BackendError);
}

void
writeBehindDeviceMemory(unsigned* values)
{
  values[blockIdx.x * THREADS + threadIdx.x + 1] = 7;
}

void
writeBehindSharedMemory(unsigned*)
{
  reinterpret_cast<unsigned*>(sharedMemory())[threadIdx.x + 1] = 7;
}

/** \brief The address sanitizer stops the program; without it, the stream reports. */
#if defined(__SANITIZE_ADDRESS__)
#define PCL_FLASHREG_EXPECT_CAUGHT(statement)                                          \
  EXPECT_DEATH(statement, "use-after-poison")
#else
#define PCL_FLASHREG_EXPECT_CAUGHT(statement) EXPECT_THROW(statement, BackendError)
#endif

TEST_F(CudaEmulation, StoreBehindDeviceMemoryIsCaught)
{
  PCL_FLASHREG_EXPECT_CAUGHT(run(&writeBehindDeviceMemory, TWO_BLOCKS));
}

TEST_F(CudaEmulation, StoreBehindSharedMemoryIsCaught)
{
  PCL_FLASHREG_EXPECT_CAUGHT(run(&writeBehindSharedMemory, TWO_BLOCKS));
}

void
sumsAndScans(unsigned* values)
{
  auto& scratch = *reinterpret_cast<BlockScratch*>(sharedMemory());
  unsigned total = 0;
  const unsigned before = blockExclusiveScan(threadIdx.x, scratch, total);
  const bool right = before == threadIdx.x * (threadIdx.x - 1) / 2 &&
                     total == THREADS * (THREADS - 1) / 2 &&
                     warpSum(laneIndex()) == WARP * (WARP - 1) / 2 &&
                     blockMax(threadIdx.x, scratch) == THREADS - 1 &&
                     __shfl_sync(ALL_LANES, laneIndex(), 5) == 5;
  values[blockIdx.x * THREADS + threadIdx.x] = right;
}

TEST_F(CudaEmulation, SumsScansAndMaxima)
{
  const Shape shape{dim3(2), dim3(THREADS), sizeof(BlockScratch)};
  for (const auto& result : runInAllOrders(&sumsAndScans, shape))
    EXPECT_EQ(std::count(result.begin(), result.end(), 1u), 2 * THREADS);
}

/** \brief Reads what the other block wrote. */
void
exchangeBlocks(unsigned* values)
{
  values[blockIdx.x * THREADS + threadIdx.x] = 100 + blockIdx.x;
  cooperative_groups::this_grid().sync();
  const unsigned other = values[(1 - blockIdx.x) * THREADS + threadIdx.x];
  cooperative_groups::this_grid().sync();
  values[blockIdx.x * THREADS + threadIdx.x] = other;
}

TEST_F(CudaEmulation, BlocksOfACooperativeLaunchWaitForEachOther)
{
  for (const Order order : {Order::Forward, Order::Reversed, Order::Random}) {
    cuda_emulation::device().order = order;
    const auto result = run(&exchangeBlocks, TWO_BLOCKS, true);
    EXPECT_EQ(result[0], 101u);
    EXPECT_EQ(result[THREADS], 100u);
  }
}

TEST_F(CudaEmulation, CooperativeLaunchOfTooManyBlocksIsAnError)
{
  Shape shape = TWO_BLOCKS;
  shape.grid.x = 1 + residentBlocks(&exchangeBlocks, shape, 2);
  EXPECT_THROW(run(&exchangeBlocks, shape, true), BackendError);
}

TEST_F(CudaEmulation, NothingHappensBeforeSomebodyWaits)
{
  values_.reserve(VALUES);
  host_.data()[0] = 1;
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(
      host_.data(), values_.data(), 4, cudaMemcpyDeviceToHost, stream_.get()));
  EXPECT_EQ(host_.data()[0], 1u);
  stream_.synchronize();
  EXPECT_NE(host_.data()[0], 1u);
}

TEST_F(CudaEmulation, ErrorsNameTheCallAndTheLine)
{
  cuda_emulation::device().allocations_left = 0;
  DeviceBuffer<unsigned> buffer;
  try {
    buffer.reserve(1);
    FAIL();
  }
  catch (const BackendError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("cudaErrorMemoryAllocation"), std::string::npos) << message;
    EXPECT_NE(message.find("memory.h:"), std::string::npos) << message;
  }
  EXPECT_EQ(buffer.capacity(), 0u);
}

} // namespace
} // namespace cuda
} // namespace pcl_flashreg
