// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Stands in for cuBLAS's header of this name: products as sums, in the order of the stream.

#include "cuda_runtime.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

enum cublasStatus_t { CUBLAS_STATUS_SUCCESS = 0, CUBLAS_STATUS_EXECUTION_FAILED = 13 };
enum cublasOperation_t { CUBLAS_OP_N = 0 };
enum cudaDataType_t { CUDA_R_32F = 0, CUDA_R_16F = 2 };
enum cublasComputeType_t { CUBLAS_COMPUTE_32F = 68 };
enum cublasGemmAlgo_t { CUBLAS_GEMM_DEFAULT = -1 };

struct cublasContext {
  cudaStream_t stream = nullptr;
};
using cublasHandle_t = cublasContext*;

inline const char*
cublasGetStatusString(cublasStatus_t status)
{
  return status == CUBLAS_STATUS_SUCCESS ? "success" : "the launch failed";
}

inline cublasStatus_t
cublasCreate(cublasHandle_t* handle)
{
  *handle = new cublasContext;
  return CUBLAS_STATUS_SUCCESS;
}
inline cublasStatus_t
cublasDestroy(cublasHandle_t handle)
{
  delete handle;
  return CUBLAS_STATUS_SUCCESS;
}
inline cublasStatus_t
cublasSetStream(cublasHandle_t handle, cudaStream_t stream)
{
  handle->stream = stream;
  return CUBLAS_STATUS_SUCCESS;
}
inline cublasStatus_t
cublasSetWorkspace(cublasHandle_t, void*, std::size_t)
{
  return CUBLAS_STATUS_SUCCESS;
}

namespace cuda_emulation {

inline float
toFloat(float value)
{
  return value;
}
/** \brief IEEE half precision, finite and not subnormal. */
inline float
toFloat(std::uint16_t bits)
{
  if ((bits & 0x7FFF) == 0)
    return 0;
  const float size =
      std::ldexp(static_cast<float>(1024 + (bits & 0x3FF)), ((bits >> 10) & 0x1F) - 25);
  return (bits & 0x8000) != 0 ? -size : size;
}

/** \brief C = alpha A B + beta C, by columns; A's zeros, of which there are many, are
 * passed over. */
template <typename Value>
cublasStatus_t
multiply(cublasHandle_t handle,
         int m,
         int n,
         int k,
         float alpha,
         const Value* a,
         int stride_a,
         const Value* b,
         int stride_b,
         float beta,
         float* c,
         int stride_c)
{
  const auto body = [=] {
    for (std::ptrdiff_t j = 0; j < n; ++j) {
      float* column = c + j * stride_c;
      for (int i = 0; i < m; ++i)
        column[i] = beta == 0 ? 0 : beta * column[i];
      for (std::ptrdiff_t l = 0; l < k; ++l) {
        const float factor = alpha * toFloat(b[j * stride_b + l]);
        if (factor != 0)
          for (int i = 0; i < m; ++i)
            column[i] += toFloat(a[l * stride_a + i]) * factor;
      }
    }
  };
  return enqueueGrid(handle->stream, 1, 1, 0, false, body) == cudaSuccess
             ? CUBLAS_STATUS_SUCCESS
             : CUBLAS_STATUS_EXECUTION_FAILED;
}

} // namespace cuda_emulation

inline cublasStatus_t
cublasSgemm(cublasHandle_t handle,
            cublasOperation_t,
            cublasOperation_t,
            int m,
            int n,
            int k,
            const float* alpha,
            const float* a,
            int stride_a,
            const float* b,
            int stride_b,
            const float* beta,
            float* c,
            int stride_c)
{
  return cuda_emulation::multiply(
      handle, m, n, k, *alpha, a, stride_a, b, stride_b, *beta, c, stride_c);
}

/** \brief Inputs in half precision, the rest in single precision. */
inline cublasStatus_t
cublasGemmEx(cublasHandle_t handle,
             cublasOperation_t,
             cublasOperation_t,
             int m,
             int n,
             int k,
             const void* alpha,
             const void* a,
             cudaDataType_t,
             int stride_a,
             const void* b,
             cudaDataType_t,
             int stride_b,
             const void* beta,
             void* c,
             cudaDataType_t,
             int stride_c,
             cublasComputeType_t,
             cublasGemmAlgo_t)
{
  return cuda_emulation::multiply(handle,
                                  m,
                                  n,
                                  k,
                                  *static_cast<const float*>(alpha),
                                  static_cast<const std::uint16_t*>(a),
                                  stride_a,
                                  static_cast<const std::uint16_t*>(b),
                                  stride_b,
                                  *static_cast<const float*>(beta),
                                  static_cast<float*>(c),
                                  stride_c);
}
