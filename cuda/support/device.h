// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/support/error.h"

namespace pcl_flashreg {
namespace cuda {

/** \brief Makes a device the calling thread's as long as it lives. Which one a thread works
 * with is a state of the thread, and an object may be used by another thread than made it. */
class CurrentDevice {
public:
  explicit CurrentDevice(int device) : device_(device)
  {
    PCL_FLASHREG_CUDA(cudaGetDevice(&before_));
    if (before_ != device_)
      PCL_FLASHREG_CUDA(cudaSetDevice(device_));
  }
  ~CurrentDevice()
  {
    if (before_ != device_)
      cudaSetDevice(before_);
  }
  CurrentDevice(const CurrentDevice&) = delete;
  CurrentDevice&
  operator=(const CurrentDevice&) = delete;

private:
  int device_, before_ = 0;
};

} // namespace cuda
} // namespace pcl_flashreg
