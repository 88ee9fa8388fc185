// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/result.h>

#include <vector>

namespace pcl_flashreg {

/** \brief Rows of the problem with a residual below the inlier distance, ascending; the
 * same ones as stage 6 finds. */
std::vector<int>
inliersOf(const Problem& problem, const Pose& pose, float inlier_distance);

/** \brief Score of a pose with these inliers, in units of SCORE_UNIT, as in stage 6. */
std::int64_t
scoreOf(const Problem& problem,
        const Pose& pose,
        const std::vector<int>& inliers,
        const Parameters& parameters);

/** \brief Fills in the part of the evidence that comes from correspondences. */
void
addCorrespondences(const Problem& problem,
                   const Pose& pose,
                   const std::vector<int>& inliers,
                   int rival_inliers,
                   float inlier_distance,
                   ThreadPool& pool,
                   Evidence& evidence);

} // namespace pcl_flashreg
