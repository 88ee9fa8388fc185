// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cuda/support/error.h"

#include <pcl_flashreg/estimator.h>

#include <string>

namespace pcl_flashreg {
namespace cuda {

void
fail(cudaError_t error, const char* call, const char* file, int line)
{
  cudaGetLastError(); // or the next call would report this one again
  const std::string path = file;
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const std::string called = call;
  throw BackendError("backend cuda: " + called.substr(0, called.find('(')) + ": " +
                     cudaGetErrorString(error) + " (" + cudaGetErrorName(error) +
                     "), " + name + ":" + std::to_string(line));
}

} // namespace cuda
} // namespace pcl_flashreg
