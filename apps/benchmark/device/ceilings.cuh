// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cuda_runtime.h>

#include <cstddef>

namespace pcl_flashreg {
namespace benchmark {

/** \brief Puts chains of fused multiplications and additions into the stream.
 * \param[out] result one float a thread, so that nothing is left out
 * \return how many operations they are */
double
runArithmetic(unsigned blocks, float* result, cudaStream_t stream);

/** \brief Floats that runArithmetic() and runReads() write for so many blocks. */
std::size_t
resultSize(unsigned blocks);

/** \brief Puts reads of a whole buffer, again and again by all blocks, into the stream.
 * \param[in] buffer of `size` times 16 bytes
 * \return how many bytes they read */
double
runReads(unsigned blocks,
         const uint4* buffer,
         std::size_t size,
         float* result,
         cudaStream_t stream);

} // namespace benchmark
} // namespace pcl_flashreg
