// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "dense_matrix.cuh"
#include "cuda/support/memory.h"
#include "cuda/support/stream.h"

#include <cublas_v2.h>

namespace pcl_flashreg {
namespace dense {

/** \brief Products of matrices by cuBLAS, in a stream, with a workspace of its own. */
class Product {
public:
  /** \throws BackendError */
  explicit Product(const cuda::Stream& stream);
  Product(const Product&) = delete;
  Product&
  operator=(const Product&) = delete;
  ~Product();

  /** \brief product = graph * graph, of a symmetric matrix of 0 and 1: exact in either
   * precision, since single precision holds all counts below 2^24.
   * \throws BackendError */
  void
  square(Matrix<float> graph, Matrix<float> product, std::size_t size) const;
  void
  square(Matrix<Half> graph, Matrix<float> product, std::size_t size) const;

  std::size_t
  deviceBytes() const
  {
    return workspace_.bytes();
  }

private:
  cublasHandle_t handle_ = nullptr;
  cuda::DeviceBuffer<unsigned char> workspace_;
};

} // namespace dense
} // namespace pcl_flashreg
