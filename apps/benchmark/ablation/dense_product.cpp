// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "dense_product.h"

#include <pcl_flashreg/estimator.h>

#include <string>

namespace pcl_flashreg {
namespace dense {
namespace {

/** \brief What NVIDIA recommends from Hopper on; older devices ask for less. */
constexpr std::size_t WORKSPACE_BYTES = std::size_t{32} << 20;

void
check(cublasStatus_t status, const char* call)
{
  if (status != CUBLAS_STATUS_SUCCESS)
    throw BackendError("backend cuda: " + std::string(call) + ": " +
                       cublasGetStatusString(status));
}

} // namespace

Product::Product(const cuda::Stream& stream)
{
  workspace_.reserve(WORKSPACE_BYTES);
  check(cublasCreate(&handle_), "cublasCreate");
  try {
    check(cublasSetStream(handle_, stream.get()), "cublasSetStream");
    check(cublasSetWorkspace(handle_, workspace_.data(), workspace_.bytes()),
          "cublasSetWorkspace");
  }
  catch (...) {
    cublasDestroy(handle_);
    throw;
  }
}

Product::~Product()
{
  cublasDestroy(handle_);
}

// cuBLAS takes columns for rows, which makes no difference to symmetric matrices.

void
Product::square(Matrix<float> graph, Matrix<float> product, std::size_t size) const
{
  const int n = static_cast<int>(size), stride = static_cast<int>(graph.stride);
  const float one = 1, zero = 0;
  if (n > 0)
    check(cublasSgemm(handle_,
                      CUBLAS_OP_N,
                      CUBLAS_OP_N,
                      n,
                      n,
                      n,
                      &one,
                      graph.values,
                      stride,
                      graph.values,
                      stride,
                      &zero,
                      product.values,
                      static_cast<int>(product.stride)),
          "cublasSgemm");
}

void
Product::square(Matrix<Half> graph, Matrix<float> product, std::size_t size) const
{
  const int n = static_cast<int>(size), stride = static_cast<int>(graph.stride);
  const float one = 1, zero = 0;
  if (n > 0)
    check(cublasGemmEx(handle_,
                       CUBLAS_OP_N,
                       CUBLAS_OP_N,
                       n,
                       n,
                       n,
                       &one,
                       graph.values,
                       CUDA_R_16F,
                       stride,
                       graph.values,
                       CUDA_R_16F,
                       stride,
                       &zero,
                       product.values,
                       CUDA_R_32F,
                       static_cast<int>(product.stride),
                       CUBLAS_COMPUTE_32F,
                       CUBLAS_GEMM_DEFAULT),
          "cublasGemmEx");
}

} // namespace dense
} // namespace pcl_flashreg
