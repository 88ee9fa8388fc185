// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"
#include "support/thread_pool.h"

#include <vector>

namespace pcl_flashreg {

/** \brief Evidence::mirrored: whether a reflection of the source explains the correspondences
 * better than any motion does.
 *
 * A clique keeps its distances in a mirrored cloud, and three points lie in a plane: what
 * aligns them, with the source turned over about that plane, is the reflection that they speak
 * for. The best of these are refined as hypotheses are.
 * \param[in] cliques the best ones first
 * \param[in] motions the best ones
 */
double
mirroredEvidence(const Problem& problem,
                 const std::vector<Clique>& cliques,
                 const std::vector<Pose>& motions,
                 float inlier_distance,
                 ThreadPool& pool);

} // namespace pcl_flashreg
