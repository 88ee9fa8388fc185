// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/support/error.h"

#include <cstddef>

namespace pcl_flashreg {
namespace cuda {

/** \brief Blocks, threads a block, bytes of dynamic shared memory. */
struct Shape {
  dim3 grid, block;
  std::size_t shared_bytes = 0;
};

/** \brief What every block gets without being asked for. */
constexpr std::size_t USUAL_SHARED_BYTES = 48 * 1024;

template <typename... Parameters>
void
allowSharedMemory(void (*kernel)(Parameters...), std::size_t bytes)
{
  if (bytes > USUAL_SHARED_BYTES)
    PCL_FLASHREG_CUDA(cudaFuncSetAttribute(
        kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(bytes)));
}

/** \brief Puts a kernel into the stream. A function and no <<<>>>, so that the host's
 * compiler reads the same source; a grid without blocks is no work. */
template <typename... Parameters>
void
launch(void (*kernel)(Parameters...),
       const Shape& shape,
       cudaStream_t stream,
       Parameters... arguments)
{
  if (shape.grid.x == 0 || shape.grid.y == 0)
    return;
  allowSharedMemory(kernel, shape.shared_bytes);
  void* pointers[] = {static_cast<void*>(&arguments)...};
  PCL_FLASHREG_CUDA(cudaLaunchKernel(
      kernel, shape.grid, shape.block, pointers, shape.shared_bytes, stream));
}

/** \brief The same for a kernel whose blocks wait for each other: they must all be
 * resident, see residentBlocks(). */
template <typename... Parameters>
void
launchCooperative(void (*kernel)(Parameters...),
                  const Shape& shape,
                  cudaStream_t stream,
                  Parameters... arguments)
{
  allowSharedMemory(kernel, shape.shared_bytes);
  void* pointers[] = {static_cast<void*>(&arguments)...};
  PCL_FLASHREG_CUDA(cudaLaunchCooperativeKernel(
      kernel, shape.grid, shape.block, pointers, shape.shared_bytes, stream));
}

/** \brief How many blocks of this kernel the whole device holds at once. */
template <typename... Parameters>
unsigned
residentBlocks(void (*kernel)(Parameters...),
               const Shape& shape,
               unsigned multiprocessors)
{
  allowSharedMemory(kernel, shape.shared_bytes);
  int blocks = 0;
  PCL_FLASHREG_CUDA(cudaOccupancyMaxActiveBlocksPerMultiprocessor(
      &blocks, kernel, static_cast<int>(shape.block.x), shape.shared_bytes));
  return static_cast<unsigned>(blocks) * multiprocessors;
}

} // namespace cuda
} // namespace pcl_flashreg
