// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>

namespace pcl_flashreg::benchmark {

/** \brief What the processor calls itself, e.g. "Intel(R) Xeon(R) Processor", and how many
 * of them the system shows. */
std::string
processorName();

/** \brief The commit that this was built from, "-dirty" behind it if there were changes;
 * "unknown" outside of a repository. */
const char*
commit();

/** \brief CMake's build type. */
const char*
buildType();

} // namespace pcl_flashreg::benchmark
