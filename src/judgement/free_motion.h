// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/walk.h"

#include <pcl_flashreg/result.h>

#include <vector>

namespace pcl_flashreg {

/** \brief Result::free_motions, in the centred frame of the target. */
std::vector<FreeMotion>
freeMotionsOf(const std::vector<Walk>& walks);

} // namespace pcl_flashreg
