// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "support/thread_pool.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <numeric>
#include <stdexcept>

namespace pcl_flashreg {
namespace cpu {
namespace {

TEST(ThreadPool, RunsEveryTaskOnce)
{
  for (const unsigned threads : {1u, 2u, 5u}) {
    ThreadPool pool(threads);
    for (const std::size_t count : {0u, 1u, 2u, 3u, 1000u}) {
      std::vector<std::atomic<int>> runs(count);
      pool.forEach(count, [&](std::size_t i, std::size_t thread) {
        EXPECT_LT(thread, pool.size());
        ++runs[i];
      });
      for (const auto& n : runs)
        ASSERT_EQ(n.load(), 1);
    }
  }
}

TEST(ThreadPool, SurvivesManyShortLoops)
{
  ThreadPool pool(4);
  std::vector<long> sums(64);
  for (int loop = 0; loop < 5000; ++loop)
    pool.forEach(sums.size(), [&](std::size_t i, std::size_t) { sums[i] += 1; });
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0L), 64 * 5000L);
}

TEST(ThreadPool, HandsExceptionsToTheCallerAndGoesOn)
{
  for (const unsigned threads : {1u, 3u}) {
    ThreadPool pool(threads);
    const auto fail = [](std::size_t i, std::size_t) {
      if (i == 7)
        throw std::runtime_error("seven");
    };
    EXPECT_THROW(pool.forEach(100, fail), std::runtime_error);
    std::atomic<int> runs{0};
    pool.forEach(100, [&](std::size_t, std::size_t) { ++runs; });
    EXPECT_EQ(runs.load(), 100);
  }
}

TEST(ThreadPool, NeverUsedCostsNoThread)
{
  std::vector<std::unique_ptr<ThreadPool>> pools;
  for (int i = 0; i < 2000; ++i)
    pools.push_back(std::make_unique<ThreadPool>(64));
  EXPECT_EQ(pools.back()->size(), 64u);
}

} // namespace
} // namespace cpu
} // namespace pcl_flashreg
