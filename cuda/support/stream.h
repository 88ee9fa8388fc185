// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/support/error.h"

#include <utility>

namespace pcl_flashreg {
namespace cuda {

/** \brief A mark in a stream whose time can be told. */
class Event {
public:
  Event()
  {
    PCL_FLASHREG_CUDA(cudaEventCreateWithFlags(&event_, cudaEventDefault));
  }
  Event(Event&& other) noexcept : event_(std::exchange(other.event_, nullptr)) {}
  Event&
  operator=(Event&& other) noexcept
  {
    std::swap(event_, other.event_);
    return *this;
  }
  ~Event()
  {
    if (event_)
      cudaEventDestroy(event_);
  }

  cudaEvent_t
  get() const
  {
    return event_;
  }

  void
  record(cudaStream_t stream)
  {
    PCL_FLASHREG_CUDA(cudaEventRecord(event_, stream));
  }

  void
  synchronize() const
  {
    PCL_FLASHREG_CUDA(cudaEventSynchronize(event_));
  }

  /** \brief From this event to another; both must have happened. */
  double
  millisecondsTo(const Event& later) const
  {
    float milliseconds = 0;
    PCL_FLASHREG_CUDA(cudaEventElapsedTime(&milliseconds, event_, later.event_));
    return milliseconds;
  }

private:
  cudaEvent_t event_ = nullptr;
};

/** \brief A queue of work of its own, independent of the default stream. */
class Stream {
public:
  Stream()
  {
    PCL_FLASHREG_CUDA(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking));
  }
  Stream(Stream&& other) noexcept : stream_(std::exchange(other.stream_, nullptr)) {}
  Stream&
  operator=(Stream&& other) noexcept
  {
    std::swap(stream_, other.stream_);
    return *this;
  }
  ~Stream()
  {
    if (stream_)
      cudaStreamDestroy(stream_);
  }

  cudaStream_t
  get() const
  {
    return stream_;
  }

  void
  synchronize() const
  {
    PCL_FLASHREG_CUDA(cudaStreamSynchronize(stream_));
  }

  /** \brief What comes after waits on the device for a mark in another stream. */
  void
  waitFor(const Event& event) const
  {
    PCL_FLASHREG_CUDA(cudaStreamWaitEvent(stream_, event.get(), 0));
  }

private:
  cudaStream_t stream_ = nullptr;
};

} // namespace cuda
} // namespace pcl_flashreg
