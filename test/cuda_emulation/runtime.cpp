// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cuda_runtime.h"

#include "emulation.h"
#include "guarded_memory.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <vector>

namespace cuda_emulation {

/** \brief Work that waits for the stream to be waited for. */
struct Stream {
  int device = 0;
  std::vector<std::function<cudaError_t()>> work;
};

struct Event {
  std::chrono::steady_clock::time_point time;
  /** \brief That it was put into; null once it has happened. */
  Stream* stream = nullptr;
};

namespace {

struct Runtime {
  /** \brief Held by every call, also while kernels run: threads of the host may share the
   * device, and take turns. */
  std::recursive_mutex mutex;
  Device device;
  Counters counters;
  std::string failure;
  std::map<void*, std::unique_ptr<GuardedMemory>> device_memory, pinned_memory;
  /** \brief The default stream is the first. */
  Stream default_stream;
  std::set<Stream*> streams{&default_stream};
  cudaError_t last = cudaSuccess;
};

Runtime&
runtime()
{
  static Runtime instance;
  return instance;
}

/** \brief The device of the calling thread. */
thread_local int current_device = 0;

Stream&
streamOf(cudaStream_t stream)
{
  return stream ? *stream : runtime().default_stream;
}

std::lock_guard<std::recursive_mutex>
lock()
{
  return std::lock_guard<std::recursive_mutex>(runtime().mutex);
}

cudaError_t
report(cudaError_t error)
{
  if (error != cudaSuccess)
    runtime().last = error;
  return error;
}

cudaError_t
run(Stream& stream)
{
  const std::vector<std::function<cudaError_t()>> work = std::move(stream.work);
  stream.work.clear();
  for (const auto& item : work) {
    const cudaError_t error = item();
    if (error != cudaSuccess)
      return report(error);
  }
  return cudaSuccess;
}

/** \brief As allocating and freeing do: everything that was put into streams is done. */
cudaError_t
runAll()
{
  for (Stream* stream : runtime().streams) {
    const cudaError_t error = run(*stream);
    if (error != cudaSuccess)
      return error;
  }
  return cudaSuccess;
}

bool
memoryIntact()
{
  for (const auto& [address, memory] : runtime().device_memory)
    if (!memory->intact())
      return false;
  return true;
}

bool
isPinned(const void* address)
{
  for (const auto& [begin, memory] : runtime().pinned_memory)
    if (address >= begin && address < memory->data() + memory->size())
      return true;
  return false;
}

/** \brief Takes one from a number of things that still succeed. */
bool
take(std::size_t& left)
{
  if (left == 0)
    return false;
  --left;
  return true;
}

} // namespace

Device&
device()
{
  return runtime().device;
}

Counters&
counters()
{
  return runtime().counters;
}

void
reset()
{
  Runtime& r = runtime();
  r.device = Device{};
  const std::size_t bytes = r.counters.bytes;
  r.counters = Counters{};
  r.counters.bytes = r.counters.peak_bytes = bytes;
  r.failure.clear();
  r.last = cudaSuccess;
}

std::string
lastFailure()
{
  return runtime().failure;
}

cudaError_t
kernelImage()
{
  const auto guard = lock();
  return report(device().has_kernel_image ? cudaSuccess
                                          : cudaErrorNoKernelImageForDevice);
}

int
residentBlocks()
{
  return device().blocks_a_multiprocessor;
}

cudaError_t
enqueueGrid(Stream* stream,
            const dim3& grid,
            const dim3& block,
            std::size_t shared_bytes,
            bool at_once,
            std::function<void()> body)
{
  const auto guard = lock();
  const Device& d = device();
  if (streamOf(stream).device != current_device)
    return report(cudaErrorInvalidResourceHandle);
  if (grid.x == 0 || grid.y == 0 || grid.z == 0 || grid.y > 65535 || grid.z > 65535 ||
      block.x * block.y * block.z == 0 || block.x * block.y * block.z > 1024)
    return report(cudaErrorInvalidValue);
  if (at_once &&
      (!d.cooperative_launch ||
       grid.x > static_cast<unsigned>(d.multiprocessors * d.blocks_a_multiprocessor)))
    return report(cudaErrorLaunchOutOfResources);
  if (!take(device().launches_left))
    return report(cudaErrorLaunchFailure);
  ++counters().launches;
  counters().cooperative_launches += at_once;
  streamOf(stream).work.push_back([=] {
    const char* failure = runGrid(grid, block, shared_bytes, at_once, body);
    if (failure) {
      runtime().failure = failure;
      return cudaErrorLaunchFailure;
    }
    if (!memoryIntact()) {
      runtime().failure = "a store outside of device memory";
      return cudaErrorIllegalAddress;
    }
    return cudaSuccess;
  });
  return cudaSuccess;
}

} // namespace cuda_emulation

using namespace cuda_emulation;

const char*
cudaGetErrorName(cudaError_t error)
{
  switch (error) {
  case cudaSuccess:
    return "cudaSuccess";
  case cudaErrorInvalidValue:
    return "cudaErrorInvalidValue";
  case cudaErrorMemoryAllocation:
    return "cudaErrorMemoryAllocation";
  case cudaErrorNoDevice:
    return "cudaErrorNoDevice";
  case cudaErrorInvalidDevice:
    return "cudaErrorInvalidDevice";
  case cudaErrorInvalidResourceHandle:
    return "cudaErrorInvalidResourceHandle";
  case cudaErrorNoKernelImageForDevice:
    return "cudaErrorNoKernelImageForDevice";
  case cudaErrorIllegalAddress:
    return "cudaErrorIllegalAddress";
  case cudaErrorLaunchOutOfResources:
    return "cudaErrorLaunchOutOfResources";
  case cudaErrorLaunchFailure:
    return "cudaErrorLaunchFailure";
  }
  return "unknown";
}

const char*
cudaGetErrorString(cudaError_t error)
{
  return cudaGetErrorName(error);
}

cudaError_t
cudaGetLastError()
{
  const auto guard = lock();
  return std::exchange(runtime().last, cudaSuccess);
}

cudaError_t
cudaGetDeviceCount(int* count)
{
  const auto guard = lock();
  *count = device().count;
  return report(device().count > 0 ? cudaSuccess : cudaErrorNoDevice);
}

cudaError_t
cudaGetDevice(int* number)
{
  const auto guard = lock();
  *number = current_device;
  return report(device().count > 0 ? cudaSuccess : cudaErrorNoDevice);
}

cudaError_t
cudaSetDevice(int number)
{
  const auto guard = lock();
  if (number < 0 || number >= device().count)
    return report(cudaErrorInvalidDevice);
  current_device = number;
  return cudaSuccess;
}

cudaError_t
cudaGetDeviceProperties(cudaDeviceProp* properties, int)
{
  std::strcpy(properties->name, "emulated device");
  return cudaSuccess;
}

cudaError_t
cudaDeviceGetPCIBusId(char* id, int length, int)
{
  std::strncpy(id, "none", static_cast<std::size_t>(length));
  return cudaSuccess;
}

cudaError_t
cudaMemGetInfo(std::size_t* free, std::size_t* total)
{
  const auto guard = lock();
  const Runtime& r = runtime();
  *total = r.device.memory;
  *free = *total - std::min(*total, r.counters.bytes);
  return cudaSuccess;
}

cudaError_t
cudaDeviceGetAttribute(int* value, cudaDeviceAttr attribute, int)
{
  const auto guard = lock();
  switch (attribute) {
  case cudaDevAttrMultiProcessorCount:
    *value = device().multiprocessors;
    break;
  case cudaDevAttrComputeCapabilityMajor:
    *value = device().major;
    break;
  case cudaDevAttrComputeCapabilityMinor:
    *value = device().minor;
    break;
  case cudaDevAttrCooperativeLaunch:
    *value = device().cooperative_launch;
    break;
  }
  return cudaSuccess;
}

cudaError_t
cudaMalloc(void** memory, std::size_t bytes)
{
  const auto guard = lock();
  Runtime& r = runtime();
  runAll();
  *memory = nullptr;
  if (bytes > r.device.memory - std::min(r.device.memory, r.counters.bytes) ||
      !take(r.device.allocations_left))
    return report(cudaErrorMemoryAllocation);
  auto allocated = std::make_unique<GuardedMemory>(bytes);
  *memory = allocated->data();
  r.device_memory[*memory] = std::move(allocated);
  ++r.counters.allocations;
  r.counters.bytes += bytes;
  r.counters.peak_bytes = std::max(r.counters.peak_bytes, r.counters.bytes);
  return cudaSuccess;
}

cudaError_t
cudaFree(void* memory)
{
  const auto guard = lock();
  Runtime& r = runtime();
  if (!memory)
    return cudaSuccess;
  runAll();
  const auto found = r.device_memory.find(memory);
  if (found == r.device_memory.end())
    return report(cudaErrorInvalidValue);
  r.counters.bytes -= found->second->size();
  r.device_memory.erase(found);
  return cudaSuccess;
}

cudaError_t
cudaMallocHost(void** memory, std::size_t bytes)
{
  const auto guard = lock();
  Runtime& r = runtime();
  *memory = nullptr;
  if (!take(r.device.allocations_left))
    return report(cudaErrorMemoryAllocation);
  auto allocated = std::make_unique<GuardedMemory>(bytes);
  *memory = allocated->data();
  r.pinned_memory[*memory] = std::move(allocated);
  ++r.counters.allocations;
  return cudaSuccess;
}

cudaError_t
cudaFreeHost(void* memory)
{
  const auto guard = lock();
  runAll();
  return report(!memory || runtime().pinned_memory.erase(memory) == 1
                    ? cudaSuccess
                    : cudaErrorInvalidValue);
}

cudaError_t
cudaMemcpyAsync(void* to,
                const void* from,
                std::size_t bytes,
                cudaMemcpyKind kind,
                cudaStream_t stream)
{
  const auto guard = lock();
  ++counters().copies;
  const bool stays = kind == cudaMemcpyDefault
                         ? isPinned(from) || isPinned(to)
                         : isPinned(kind == cudaMemcpyHostToDevice ? from : to);
  if (!stays) {
    // Memory that is not pinned is copied before the call returns.
    const cudaError_t error = run(streamOf(stream));
    std::memcpy(to, from, bytes);
    return error;
  }
  streamOf(stream).work.push_back([=] {
    std::memcpy(to, from, bytes);
    return cudaSuccess;
  });
  return cudaSuccess;
}

cudaError_t
cudaMemsetAsync(void* memory, int value, std::size_t bytes, cudaStream_t stream)
{
  const auto guard = lock();
  streamOf(stream).work.push_back([=] {
    std::memset(memory, value, bytes);
    return cudaSuccess;
  });
  return cudaSuccess;
}

cudaError_t
cudaStreamCreateWithFlags(cudaStream_t* stream, unsigned)
{
  const auto guard = lock();
  *stream = new Stream;
  (*stream)->device = current_device;
  runtime().streams.insert(*stream);
  return cudaSuccess;
}

cudaError_t
cudaStreamDestroy(cudaStream_t stream)
{
  const auto guard = lock();
  const cudaError_t error = run(*stream);
  runtime().streams.erase(stream);
  delete stream;
  return error;
}

cudaError_t
cudaStreamSynchronize(cudaStream_t stream)
{
  const auto guard = lock();
  ++counters().synchronisations;
  return run(streamOf(stream));
}

cudaError_t
cudaEventCreateWithFlags(cudaEvent_t* event, unsigned)
{
  const auto guard = lock();
  *event = new Event;
  return cudaSuccess;
}

cudaError_t
cudaEventDestroy(cudaEvent_t event)
{
  const auto guard = lock();
  delete event;
  return cudaSuccess;
}

cudaError_t
cudaEventRecord(cudaEvent_t event, cudaStream_t stream)
{
  const auto guard = lock();
  if (streamOf(stream).device != current_device)
    return report(cudaErrorInvalidResourceHandle);
  event->stream = &streamOf(stream);
  event->stream->work.push_back([event] {
    event->time = std::chrono::steady_clock::now();
    event->stream = nullptr;
    return cudaSuccess;
  });
  return cudaSuccess;
}

cudaError_t
cudaEventSynchronize(cudaEvent_t event)
{
  const auto guard = lock();
  ++counters().synchronisations;
  return event->stream ? run(*event->stream) : cudaSuccess;
}

cudaError_t
cudaStreamWaitEvent(cudaStream_t stream, cudaEvent_t event, unsigned)
{
  const auto guard = lock();
  streamOf(stream).work.push_back(
      [event] { return event->stream ? run(*event->stream) : cudaSuccess; });
  return cudaSuccess;
}

cudaError_t
cudaEventElapsedTime(float* milliseconds, cudaEvent_t begin, cudaEvent_t end)
{
  const auto guard = lock();
  *milliseconds =
      std::chrono::duration<float, std::milli>(end->time - begin->time).count();
  return cudaSuccess;
}
