// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "method.h"

namespace pcl_flashreg::evaluate {

// One file a family; those of other libraries are compiled where CMake found them.

std::vector<MethodEntry>
flashregMethods();

/** \brief TurboReg's formulation on dense matrices; see dense_reference.cpp. */
std::vector<MethodEntry>
denseReferenceMethods();

std::vector<MethodEntry>
pclMethods();

std::vector<MethodEntry>
open3dMethods();

std::vector<MethodEntry>
teaserMethods();

std::vector<MethodEntry>
kissMatcherMethods();

} // namespace pcl_flashreg::evaluate
