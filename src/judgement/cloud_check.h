// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "support/thread_pool.h"
#include "estimation/problem.h"

#include <pcl_flashreg/result.h>

#include <vector>

namespace pcl_flashreg {

/** \brief A pose that was brought before the clouds. */
struct CheckedPose {
  Pose pose;
  CloudAgreement agreement;
  int inlier_count = 0;
};

/** \brief What the clouds have to say. */
struct CloudFindings {
  /** \brief Distinct poses, best first. */
  std::vector<CheckedPose> poses;
  /** \brief For the best pose; what comes from correspondences alone is not filled in,
   * but for the inliers. */
  Evidence evidence;
  /** \brief Of the best pose, in the centred frame of the target. */
  std::vector<FreeMotion> free_motions;
};

/** \brief Asks the clouds which of many hypotheses is right.
 *
 * Where both viewpoints are known, all hypotheses are screened on a few points, and the
 * best again on more. The best dozen that differ, and the favourites, are moved onto the
 * target's surface and judged on all that is known: by (matched + 1 %) /
 * (contradicted + 1 %) * sqrt(inliers + 5), or without the denominator, if the viewpoints
 * are not known or not to be believed. The same on any number of threads.
 * \param[in] hypotheses to be screened, in the centred frames of the problem
 * \param[in] favourites poses that skip the screening
 * \param[in] inlier_distance as in Parameters
 * \param[in] give_up_early see PairOptions
 * \return no pose, if a cloud has no points
 */
CloudFindings
checkOnClouds(const SurfacePair& clouds,
              const Problem& problem,
              const std::vector<Pose>& hypotheses,
              const std::vector<ScoredPose>& favourites,
              float inlier_distance,
              bool give_up_early,
              ThreadPool& pool);

} // namespace pcl_flashreg
