// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ceilings.h"

#include "ceilings.cuh"
#include "cuda/support/memory.h"
#include "cuda/support/stream.h"

#include <algorithm>

namespace pcl_flashreg::benchmark {
namespace {

/** \brief About the bit matrix and the lists of 7000 correspondences. */
constexpr std::size_t BUFFER_BYTES = std::size_t{8} << 20;
constexpr unsigned BLOCKS_A_MULTIPROCESSOR = 8;
constexpr int REPETITIONS = 5;

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
    begin.record(stream.get());
    const double work = run();
    end.record(stream.get());
    stream.synchronize();
    best = std::max(best, 1e3 * work / begin.millisecondsTo(end));
  }
  return best;
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

} // namespace pcl_flashreg::benchmark
