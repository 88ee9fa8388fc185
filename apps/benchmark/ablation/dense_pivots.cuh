// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"
#include "dense_matrix.cuh"
#include "cuda/support/memory.h"
#include "cuda/support/stream.h"

namespace pcl_flashreg {
namespace dense {

/** \brief Stage 3: the K best of a dense matrix of scores, Eq. (pivot), by CUB. Ties as in
 * docs/method.md. */
class Pivots {
public:
  Pivots();

  /** \brief Leaves Call::pivot_keys, sorted, and Control::pivots. Waits for the stream
   * once: how many scores there are to sort is known to the device alone.
   * \param[in] positives number of positive scores above the diagonal
   * \throws BackendError */
  void
  select(const cuda::Call& call,
         Matrix<float> scores,
         const unsigned long long* positives,
         const cuda::Stream& stream);

  std::size_t
  deviceBytes() const;

private:
  void
  collect(Matrix<float> scores, std::size_t rows, cudaStream_t stream);

  /** \brief Where scores stand in the matrix, and the scores; each with room to sort. */
  cuda::DeviceBuffer<unsigned> places_, scores_, other_places_, other_scores_;
  cuda::DeviceBuffer<unsigned> collected_;
  cuda::DeviceBuffer<unsigned char> scratch_;
  cuda::PinnedBuffer<unsigned long long> host_positives_;
};

} // namespace dense
} // namespace pcl_flashreg
