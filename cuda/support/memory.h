// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/support/error.h"

#include <cstddef>
#include <utility>

namespace pcl_flashreg {
namespace cuda {

/** \brief Where a Buffer's memory lies. */
struct OnDevice {
  static cudaError_t
  allocate(void** memory, std::size_t bytes)
  {
    return cudaMalloc(memory, bytes);
  }
  static void
  release(void* memory)
  {
    cudaFree(memory);
  }
};

/** \brief Host memory that a device copies from and to while the host goes on. */
struct Pinned {
  static cudaError_t
  allocate(void** memory, std::size_t bytes)
  {
    return cudaMallocHost(memory, bytes);
  }
  static void
  release(void* memory)
  {
    cudaFreeHost(memory);
  }
};

/** \brief An array of plain values, uninitialised, that grows and never shrinks; growing
 * loses the contents. */
template <typename T, typename Place>
class Buffer {
public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)),
        capacity_(std::exchange(other.capacity_, 0))
  {
  }
  Buffer&
  operator=(Buffer&& other) noexcept
  {
    std::swap(data_, other.data_);
    std::swap(capacity_, other.capacity_);
    return *this;
  }
  ~Buffer()
  {
    Place::release(data_);
  }

  /** \throws BackendError; the buffer is empty then */
  void
  reserve(std::size_t n)
  {
    if (n <= capacity_)
      return;
    // First out with the old one: both together might not fit.
    Place::release(std::exchange(data_, nullptr));
    capacity_ = 0;
    void* memory = nullptr;
    PCL_FLASHREG_CUDA(Place::allocate(&memory, n * sizeof(T)));
    data_ = static_cast<T*>(memory);
    capacity_ = n;
  }

  T*
  data() const
  {
    return data_;
  }
  std::size_t
  capacity() const
  {
    return capacity_;
  }
  std::size_t
  bytes() const
  {
    return capacity_ * sizeof(T);
  }

private:
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

template <typename T>
using DeviceBuffer = Buffer<T, OnDevice>;
template <typename T>
using PinnedBuffer = Buffer<T, Pinned>;

} // namespace cuda
} // namespace pcl_flashreg
