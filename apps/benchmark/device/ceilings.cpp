// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ceilings.h"

#include "../spread.h"
#include "ceilings.cuh"
#include "memory.h"
#include "problem.h"
#include "stream.h"
#include "trace.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::benchmark {
namespace {

/** \brief About the bit matrix and the lists of 7000 correspondences. */
constexpr std::size_t BUFFER_BYTES = std::size_t{8} << 20;
constexpr unsigned BLOCKS_A_MULTIPROCESSOR = 8;
constexpr int REPETITIONS = 5;

// The least that a test can do, all of them operations on single-precision numbers.
/** \brief Two squared lengths, 4 each from products with norms at hand, the sign of the
 * defect, 4, two comparisons and what those need, 4. */
constexpr double OPERATIONS_A_PAIR = 16;
/** \brief Three components of four operations, their square, a comparison, a count. */
constexpr double OPERATIONS_A_RESIDUAL = 17;

unsigned
multiprocessors()
{
  int device = 0, count = 0;
  PCL_FLASHREG_CUDA(cudaGetDevice(&device));
  PCL_FLASHREG_CUDA(
      cudaDeviceGetAttribute(&count, cudaDevAttrMultiProcessorCount, device));
  return static_cast<unsigned>(count);
}

/** \param[in] run puts work into the stream and returns how much
 * \return work a second, by the fastest of a few */
template <typename Run>
double
rateOf(cuda::Stream& stream, Run&& run)
{
  double best = 0;
  cuda::Event begin, end;
  for (int i = 0; i < REPETITIONS; ++i) {
    begin.record(stream);
    const double work = run();
    end.record(stream);
    stream.synchronize();
    best = std::max(best, 1e3 * work / begin.millisecondsTo(end));
  }
  return best;
}

/** \brief Bytes that scoring every edge reads at least: of the shorter of v's list and v's
 * row of bits, which is how the kernel chooses, too. */
double
leastScoreBytes(const Trace& trace, std::size_t words)
{
  std::vector<std::size_t> degree(trace.size, 0);
  for (std::size_t u = 0; u < trace.size; ++u)
    for (std::size_t w = 0; w < trace.words_per_row; ++w)
      degree[u] += static_cast<std::size_t>(
          __builtin_popcountll(trace.first_order_graph[u * trace.words_per_row + w]));
  double bytes = 0;
  for (std::size_t u = 0; u < trace.size; ++u)
    for (std::size_t v = u + 1; v < trace.size; ++v)
      if (trace.hasEdge(u, v))
        bytes += 4.0 * static_cast<double>(std::min(degree[v], words));
  return bytes;
}

} // namespace

Ceilings
measureCeilings()
{
  const unsigned blocks = multiprocessors() * BLOCKS_A_MULTIPROCESSOR;
  const std::size_t size = BUFFER_BYTES / sizeof(uint4);
  cuda::Stream stream;
  cuda::DeviceBuffer<float> result;
  result.reserve(resultSize(blocks));
  cuda::DeviceBuffer<uint4> buffer;
  buffer.reserve(size);
  PCL_FLASHREG_CUDA(cudaMemsetAsync(buffer.data(), 0x5A, BUFFER_BYTES, stream.get()));
  Ceilings ceilings;
  ceilings.operations_per_second = rateOf(
      stream, [&] { return runArithmetic(blocks, result.data(), stream.get()); });
  ceilings.cache_bytes_per_second = rateOf(stream, [&] {
    return runReads(blocks, buffer.data(), size, result.data(), stream.get());
  });
  return ceilings;
}

Floor
floorOf(const Problem& problem,
        const Trace& trace,
        bool exact,
        const Ceilings& ceilings)
{
  const auto n = static_cast<double>(problem.size);
  const auto milliseconds = [&](double operations, double bytes) {
    return 1e3 * std::max(operations / ceilings.operations_per_second,
                          bytes / ceilings.cache_bytes_per_second);
  };
  Floor floor;
  floor.first_order_graph_ms = milliseconds(n * n / 2 * OPERATIONS_A_PAIR, n * n / 8);
  floor.verification_ms = milliseconds(
      n * static_cast<double>(trace.hypotheses.size()) * OPERATIONS_A_RESIDUAL, 0);
  if (exact)
    floor.second_order_graph_ms =
        milliseconds(0, leastScoreBytes(trace, (problem.size + 31) / 32));
  return floor;
}

} // namespace pcl_flashreg::benchmark
