// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief Poses that turn the source as some that are known, and take it to other places that
 * many correspondences agree in: in a map of equal aisles, the other aisles. Their
 * correspondences share out between them what one place alone would have, so that few of them
 * ever are hypotheses.
 * \param[in] known the best first; of turns that are alike the first counts
 * \param[in] inlier_distance as in Parameters
 * \param[in] most of each turn, the most correspondences first */
std::vector<Pose>
twinsOf(const Problem& correspondences,
        const std::vector<Pose>& known,
        float inlier_distance,
        std::size_t most);

} // namespace pcl_flashreg
