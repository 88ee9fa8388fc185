// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/backend.h"
#include "cuda/estimation/options.h"

namespace pcl_flashreg {
namespace cuda {

class Stages;

/** \brief makeCudaBackend() with a say in how kernels are launched. */
std::unique_ptr<Backend>
makeBackend(const Options& options);

/** \brief The stages alone, on the device that makeBackend() takes: for comparisons.
 * \throws BackendError, with the reason, if there is no device that can be used
 */
Stages
makeStages(const Options& options);

} // namespace cuda
} // namespace pcl_flashreg
