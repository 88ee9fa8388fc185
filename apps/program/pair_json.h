// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What programs write of a registration, under the same names.

#include "json.h"

#include <pcl_flashreg/result.h>

#include <vector>

namespace pcl_flashreg::program {

/** \brief "ok", "no_clique" ... */
const char*
nameOf(Status status);

Json
evidenceOf(const Evidence& evidence);

/** \brief Its pose, inliers and score. */
Json
hypothesisOf(const Hypothesis& hypothesis);

/** \brief A list. Lengths in the unit of the clouds, turns in radians. */
Json
freeMotionsOf(const std::vector<FreeMotion>& motions);

} // namespace pcl_flashreg::program
