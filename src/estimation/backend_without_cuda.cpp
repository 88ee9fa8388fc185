// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stands in for cuda/ in a build without CUDA.

#include "estimation/backend.h"

#include <pcl_flashreg/estimator.h>

namespace pcl_flashreg {

std::unique_ptr<Backend>
makeCudaBackend()
{
  throw BackendError("backend cuda: this build has no CUDA backend; use cpu or auto");
}

} // namespace pcl_flashreg
