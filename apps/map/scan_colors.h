// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../drawing/raster.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <vector>

namespace pcl_flashreg::map {

/** \brief A color for each scan: others for scans that an edge ties, as far as there are
 * enough, and all about equally often. They differ for color-blind people, too, and on
 * white paper. */
std::vector<drawing::Color>
scanColors(const MultiviewResult& result);

} // namespace pcl_flashreg::map
