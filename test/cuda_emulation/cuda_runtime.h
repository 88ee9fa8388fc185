// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Stands in for CUDA's header of this name: as much of the runtime and of the device's
// language as the backend uses, for the host's compiler. See emulation.h.

#include "grid.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>

#define PCL_FLASHREG_CUDA_EMULATION 1

#define __global__
#define __device__
#define __host__
#define __forceinline__ inline
#define __restrict__ __restrict
#define __launch_bounds__(...)

#define threadIdx (cuda_emulation::place().thread)
#define blockIdx (cuda_emulation::place().block)
#define blockDim (cuda_emulation::place().block_size)
#define gridDim (cuda_emulation::place().grid_size)

// ---- Vector types

struct alignas(16) float4 {
  float x, y, z, w;
};
struct alignas(8) uint2 {
  unsigned x, y;
};
struct alignas(16) uint4 {
  unsigned x, y, z, w;
};
inline float4
make_float4(float x, float y, float z, float w)
{
  return {x, y, z, w};
}
inline uint4
make_uint4(unsigned x, unsigned y, unsigned z, unsigned w)
{
  return {x, y, z, w};
}

// ---- The device's functions

inline void
__syncthreads()
{
  cuda_emulation::blockBarrier();
}
inline int
__syncthreads_count(int predicate)
{
  return cuda_emulation::blockBarrier(predicate != 0);
}
inline int
__syncthreads_or(int predicate)
{
  return cuda_emulation::blockBarrier(predicate != 0) > 0;
}
inline void
__threadfence()
{
}
inline void
__syncwarp(unsigned mask = ~0u)
{
  cuda_emulation::exchange(mask, cuda_emulation::Exchange::Barrier, 0);
}
inline unsigned
__ballot_sync(unsigned mask, int predicate)
{
  return static_cast<unsigned>(
      cuda_emulation::exchange(mask, cuda_emulation::Exchange::Ballot, predicate != 0));
}
inline unsigned
__reduce_add_sync(unsigned mask, unsigned value)
{
  return static_cast<unsigned>(
      cuda_emulation::exchange(mask, cuda_emulation::Exchange::Add, value));
}
inline unsigned
__reduce_max_sync(unsigned mask, unsigned value)
{
  return static_cast<unsigned>(
      cuda_emulation::exchange(mask, cuda_emulation::Exchange::Max, value));
}

namespace cuda_emulation {

template <typename Value>
Value
shuffle(unsigned mask, Value value, unsigned lane)
{
  static_assert(sizeof(Value) <= sizeof(std::uint64_t), "at most 64 bits");
  std::uint64_t bits = 0;
  std::memcpy(&bits, &value, sizeof value);
  bits = exchange(mask, Exchange::Shuffle, bits, lane);
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

inline unsigned
lane()
{
  const Place& p = place();
  return (p.thread.x + p.block_size.x * (p.thread.y + p.block_size.y * p.thread.z)) %
         32;
}

} // namespace cuda_emulation

template <typename Value>
Value
__shfl_sync(unsigned mask, Value value, int lane)
{
  return cuda_emulation::shuffle(mask, value, static_cast<unsigned>(lane) % 32);
}
template <typename Value>
Value
__shfl_xor_sync(unsigned mask, Value value, int bits)
{
  return cuda_emulation::shuffle(mask, value, cuda_emulation::lane() ^ bits);
}
template <typename Value>
Value
__shfl_up_sync(unsigned mask, Value value, unsigned distance)
{
  const unsigned lane = cuda_emulation::lane();
  return cuda_emulation::shuffle(mask, value, lane < distance ? lane : lane - distance);
}
template <typename Value>
Value
__shfl_down_sync(unsigned mask, Value value, unsigned distance)
{
  const unsigned lane = cuda_emulation::lane();
  return cuda_emulation::shuffle(
      mask, value, lane + distance > 31 ? lane : lane + distance);
}

inline unsigned
min(unsigned a, unsigned b)
{
  return a < b ? a : b;
}
inline int
__popc(unsigned bits)
{
  return __builtin_popcount(bits);
}
inline int
__ffs(int bits)
{
  return __builtin_ffs(bits);
}
inline int
__clz(int bits)
{
  return bits == 0 ? 32 : __builtin_clz(static_cast<unsigned>(bits));
}
template <typename Value>
Value
__ldg(const Value* address)
{
  return *address;
}

// One thread of the host runs all of them, and changes at barriers only.
template <typename Value>
Value
atomicAdd(Value* address, Value value)
{
  return std::exchange(*address, *address + value);
}
template <typename Value>
Value
atomicMax(Value* address, Value value)
{
  return std::exchange(*address, *address < value ? value : *address);
}
template <typename Value>
Value
atomicOr(Value* address, Value value)
{
  return std::exchange(*address, *address | value);
}

// ---- The runtime

enum cudaError_t {
  cudaSuccess = 0,
  cudaErrorInvalidValue = 1,
  cudaErrorMemoryAllocation = 2,
  cudaErrorNoDevice = 100,
  cudaErrorInvalidDevice = 101,
  cudaErrorNoKernelImageForDevice = 209,
  cudaErrorInvalidResourceHandle = 400,
  cudaErrorIllegalAddress = 700,
  cudaErrorLaunchOutOfResources = 701,
  cudaErrorLaunchFailure = 719
};
enum cudaMemcpyKind {
  cudaMemcpyHostToDevice = 1,
  cudaMemcpyDeviceToHost = 2,
  cudaMemcpyDefault = 4
};
enum cudaDeviceAttr {
  cudaDevAttrMultiProcessorCount = 16,
  cudaDevAttrComputeCapabilityMajor = 75,
  cudaDevAttrComputeCapabilityMinor = 76,
  cudaDevAttrCooperativeLaunch = 95
};
enum cudaFuncAttribute { cudaFuncAttributeMaxDynamicSharedMemorySize = 8 };
struct cudaDeviceProp {
  char name[256];
};
struct cudaFuncAttributes {
  std::size_t sharedSizeBytes = 0;
};
constexpr unsigned cudaStreamNonBlocking = 1;
constexpr unsigned cudaEventDefault = 0, cudaEventDisableTiming = 2;

namespace cuda_emulation {
struct Stream;
struct Event;
/** \brief Puts a launch at the end of a stream. */
cudaError_t
enqueueGrid(Stream* stream,
            const dim3& grid,
            const dim3& block,
            std::size_t shared_bytes,
            bool at_once,
            std::function<void()> body);
cudaError_t
kernelImage();
int
residentBlocks();
} // namespace cuda_emulation
using cudaStream_t = cuda_emulation::Stream*;
using cudaEvent_t = cuda_emulation::Event*;

const char*
cudaGetErrorName(cudaError_t error);
const char*
cudaGetErrorString(cudaError_t error);
cudaError_t
cudaGetLastError();
cudaError_t
cudaGetDeviceCount(int* count);
cudaError_t
cudaGetDevice(int* device);
cudaError_t
cudaSetDevice(int device);
cudaError_t
cudaGetDeviceProperties(cudaDeviceProp* properties, int device);
cudaError_t
cudaDeviceGetPCIBusId(char* id, int length, int device);
cudaError_t
cudaMemGetInfo(std::size_t* free, std::size_t* total);
cudaError_t
cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int device);

cudaError_t
cudaMalloc(void** memory, std::size_t bytes);
cudaError_t
cudaFree(void* memory);
cudaError_t
cudaMallocHost(void** memory, std::size_t bytes);
cudaError_t
cudaFreeHost(void* memory);
cudaError_t
cudaMemcpyAsync(void* to,
                const void* from,
                std::size_t bytes,
                cudaMemcpyKind kind,
                cudaStream_t stream);
cudaError_t
cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t stream);

cudaError_t
cudaStreamCreateWithFlags(cudaStream_t* stream, unsigned flags);
cudaError_t
cudaStreamDestroy(cudaStream_t stream);
cudaError_t
cudaStreamSynchronize(cudaStream_t stream);
cudaError_t
cudaEventCreateWithFlags(cudaEvent_t* event, unsigned flags);
cudaError_t
cudaEventDestroy(cudaEvent_t event);
cudaError_t
cudaEventRecord(cudaEvent_t event, cudaStream_t stream);
cudaError_t
cudaEventSynchronize(cudaEvent_t event);
cudaError_t
cudaStreamWaitEvent(cudaStream_t stream, cudaEvent_t event, unsigned flags = 0);
cudaError_t
cudaEventElapsedTime(float* milliseconds, cudaEvent_t begin, cudaEvent_t end);

template <typename Kernel>
cudaError_t
cudaFuncGetAttributes(cudaFuncAttributes*, Kernel*)
{
  return cuda_emulation::kernelImage();
}
template <typename Kernel>
cudaError_t
cudaFuncSetAttribute(Kernel*, cudaFuncAttribute, int)
{
  return cuda_emulation::kernelImage();
}
template <typename Kernel>
cudaError_t
cudaOccupancyMaxActiveBlocksPerMultiprocessor(int* blocks, Kernel, int, std::size_t)
{
  *blocks = cuda_emulation::residentBlocks();
  return cuda_emulation::kernelImage();
}

namespace cuda_emulation {

/** \brief Arguments are taken over at the launch, as CUDA does. */
template <typename... Parameters, std::size_t... I>
cudaError_t
launch(void (*kernel)(Parameters...),
       const dim3& grid,
       const dim3& block,
       void** arguments,
       std::size_t shared_bytes,
       Stream* stream,
       bool at_once,
       std::index_sequence<I...>)
{
  std::tuple<Parameters...> copies(*static_cast<Parameters*>(arguments[I])...);
  return enqueueGrid(stream, grid, block, shared_bytes, at_once, [kernel, copies] {
    std::apply(kernel, copies);
  });
}

} // namespace cuda_emulation

template <typename... Parameters>
cudaError_t
cudaLaunchKernel(void (*kernel)(Parameters...),
                 dim3 grid,
                 dim3 block,
                 void** arguments,
                 std::size_t shared_bytes,
                 cudaStream_t stream)
{
  return cuda_emulation::launch(kernel,
                                grid,
                                block,
                                arguments,
                                shared_bytes,
                                stream,
                                false,
                                std::index_sequence_for<Parameters...>{});
}

template <typename... Parameters>
cudaError_t
cudaLaunchCooperativeKernel(void (*kernel)(Parameters...),
                            dim3 grid,
                            dim3 block,
                            void** arguments,
                            std::size_t shared_bytes,
                            cudaStream_t stream)
{
  return cuda_emulation::launch(kernel,
                                grid,
                                block,
                                arguments,
                                shared_bytes,
                                stream,
                                true,
                                std::index_sequence_for<Parameters...>{});
}
