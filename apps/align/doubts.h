// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "inputs.h"

#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg::align {

/** \brief Notes on what a registration met in its inputs that people should know: points
 * that were left out, viewpoints that are not believed, units that seem to differ, clouds
 * that are flat. */
void
noteDoubts(const Options& options,
           const Inputs& inputs,
           const PairResult& result,
           const Messages& messages);

} // namespace pcl_flashreg::align
