// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/backend.h"

namespace pcl_flashreg {

/** \throws BackendError if that backend is not to be had
 * \throws std::invalid_argument see cpu::selectKernels() */
std::unique_ptr<Backend>
chooseBackend(BackendKind kind, ThreadPool& pool);

} // namespace pcl_flashreg
