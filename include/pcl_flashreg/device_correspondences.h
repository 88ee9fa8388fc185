// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>

namespace pcl_flashreg {

/** \brief N putative correspondences in the memory of a CUDA device, as networks leave them;
 * nothing is owned, and who includes this needs no CUDA.
 *
 * The pointers are of the device that the estimator works on, the one that was current when it
 * was made; managed and pinned host memory will do as well. They are read after what the stream
 * holds when the call begins, and before the call returns. */
struct DeviceCorrespondences {
  /** \brief N x 3, row-major, source frame. */
  const float* source_xyz = nullptr;
  /** \brief N x 3, row-major, target frame; row i belongs to row i of source_xyz. */
  const float* target_xyz = nullptr;
  /** \brief N. */
  std::size_t size = 0;
  /** \brief N, or null: see CorrespondenceView::ranks. */
  const float* ranks = nullptr;
  /** \brief The cudaStream_t that writes them; null is the default stream. Nothing else is
   * waited for. */
  void* stream = nullptr;
  /** \brief Where 16 floats of device memory shall receive T_target_source, a row-major 4 x 4
   * matrix, or null. It is written in the stream: what is put in there after the call finds
   * it. Where no pose was found, it is the identity. */
  float* T_target_source = nullptr;
};

} // namespace pcl_flashreg
