// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/grouping.h"
#include "multiview/map_refinement.h"

#include <pcl_flashreg/multiview_registration.h>

namespace pcl_flashreg {

/** \brief The map as callers get it: groups in their order, poses between the scans' own
 * frames, and what became of each pair. */
MultiviewResult
reportOf(const Grouping& map,
         const std::vector<SurfaceEdge>& edges,
         const std::vector<PairVotes>& pairs,
         const std::vector<double>& confidences,
         const MapScans& scans);

} // namespace pcl_flashreg
