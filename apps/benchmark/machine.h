// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg::benchmark {

/** \brief What the processor calls itself, e.g. "Intel(R) Xeon(R) Processor", and how many
 * of them the system shows. */
std::string
processorName();

} // namespace pcl_flashreg::benchmark
