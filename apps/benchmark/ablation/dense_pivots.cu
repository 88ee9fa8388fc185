// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 3 on a dense matrix: positive scores above the diagonal are collected in the order
// of their places, (u, v) ascending, and sorted by score alone. The sort is stable, so that
// ties stay in that order, and goes through as many bits as a score can have.

#include "dense_pivots.cuh"

#include "cuda/support/launch.cuh"

#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_select.cuh>
#include <thrust/iterator/counting_iterator.h>

#include <algorithm>

namespace pcl_flashreg {
namespace dense {
namespace {

using namespace cuda;

constexpr unsigned THREADS = 256;

/** \brief Whether a place of the matrix holds a positive score above the diagonal. */
struct IsCandidate {
  const float* scores;
  unsigned size, stride;

  __host__ __device__ bool
  operator()(unsigned place) const
  {
    const unsigned u = place / stride, v = place % stride;
    return v > u && v < size && scores[place] > 0;
  }
};

__global__ void
__launch_bounds__(THREADS) readScores(const float* matrix,
                                      const unsigned* places,
                                      unsigned* scores,
                                      unsigned count)
{
  const unsigned i = blockIdx.x * THREADS + threadIdx.x;
  if (i < count)
    scores[i] = static_cast<unsigned>(matrix[places[i]]);
}

__global__ void
__launch_bounds__(THREADS) writeKeys(const Call call,
                                     const unsigned* places,
                                     const unsigned* scores,
                                     unsigned stride,
                                     unsigned count)
{
  const unsigned i = blockIdx.x * THREADS + threadIdx.x;
  if (i >= count)
    return;
  call.pivot_keys[i] = Pivot::key(places[i] / stride, places[i] % stride, scores[i]);
  if (i == 0)
    call.control->pivots = count;
}

Shape
aThread(unsigned items)
{
  return {dim3((items + THREADS - 1) / THREADS), dim3(THREADS), 0};
}

/** \brief Calls one of CUB's functions twice: for the scratch memory that it wants, and
 * for what it does. */
template <typename Function>
void
withScratch(DeviceBuffer<unsigned char>& scratch, const Function& function)
{
  std::size_t bytes = 0;
  PCL_FLASHREG_CUDA(function(nullptr, bytes));
  scratch.reserve(std::max<std::size_t>(1, bytes));
  PCL_FLASHREG_CUDA(function(scratch.data(), bytes));
}

/** \brief Bits of the largest score: two of n share less than n neighbours. */
int
bitsOf(unsigned n)
{
  int bits = 1;
  while (n >> bits)
    ++bits;
  return bits;
}

} // namespace

Pivots::Pivots()
{
  collected_.reserve(1);
  host_positives_.reserve(1);
}

/** \brief Leaves the places of all candidates, ascending. */
void
Pivots::collect(Matrix<float> scores, std::size_t rows, cudaStream_t stream)
{
  const auto size = static_cast<unsigned>(rows);
  const auto stride = static_cast<unsigned>(scores.stride);
  const IsCandidate candidate{scores.values, size, stride};
  withScratch(scratch_, [&](void* scratch, std::size_t& bytes) {
    return cub::DeviceSelect::If(scratch,
                                 bytes,
                                 thrust::counting_iterator<unsigned>(0),
                                 places_.data(),
                                 collected_.data(),
                                 static_cast<int>(size * stride),
                                 candidate,
                                 stream);
  });
}

void
Pivots::select(const Call& call,
               Matrix<float> scores,
               const unsigned long long* positives,
               const Stream& stream)
{
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(host_positives_.data(),
                                    positives,
                                    sizeof *positives,
                                    cudaMemcpyDeviceToHost,
                                    stream.get()));
  stream.synchronize();
  const auto count = static_cast<unsigned>(*host_positives_.data());
  if (count == 0)
    return;
  for (DeviceBuffer<unsigned>* buffer :
       {&places_, &scores_, &other_places_, &other_scores_})
    buffer->reserve(count);
  collect(scores, call.size, stream.get());
  launch(&readScores,
         aThread(count),
         stream.get(),
         static_cast<const float*>(scores.values),
         static_cast<const unsigned*>(places_.data()),
         scores_.data(),
         count);
  cub::DoubleBuffer<unsigned> keys(scores_.data(), other_scores_.data());
  cub::DoubleBuffer<unsigned> places(places_.data(), other_places_.data());
  withScratch(scratch_, [&](void* scratch, std::size_t& bytes) {
    return cub::DeviceRadixSort::SortPairsDescending(scratch,
                                                     bytes,
                                                     keys,
                                                     places,
                                                     static_cast<int>(count),
                                                     0,
                                                     bitsOf(call.size),
                                                     stream.get());
  });
  const unsigned pivots = std::min(count, call.pivots);
  launch(&writeKeys,
         aThread(pivots),
         stream.get(),
         call,
         static_cast<const unsigned*>(places.Current()),
         static_cast<const unsigned*>(keys.Current()),
         static_cast<unsigned>(scores.stride),
         pivots);
}

std::size_t
Pivots::deviceBytes() const
{
  return places_.bytes() + scores_.bytes() + other_places_.bytes() +
         other_scores_.bytes() + collected_.bytes() + scratch_.bytes();
}

} // namespace dense
} // namespace pcl_flashreg
