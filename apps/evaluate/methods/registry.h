// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "method.h"

namespace pcl_flashreg::evaluate {

/** \brief All methods of this build. Those of other libraries are there where CMake found
 * the library. */
const std::vector<MethodEntry>&
methods();

/** \brief The method of that name, or null. */
const MethodEntry*
findMethod(const std::string& name);

} // namespace pcl_flashreg::evaluate
