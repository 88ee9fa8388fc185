// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "clouds/agreement.h"
#include "cpu/thread_pool.h"
#include "problem.h"

#include <vector>

namespace pcl_flashreg {

/** \brief A pose that was brought before the clouds. */
struct CheckedPose {
  Pose pose;
  CloudAgreement agreement;
  int inlier_count = 0;
  /** \brief See evidenceOf(). */
  double evidence = 0;
};

/** \brief What speaks for a pose: the logarithm of
 * (matched + 1 %) / (contradicted + 1 %) * sqrt(inliers + 5). */
double
evidenceOf(const CloudAgreement& agreement, int inlier_count);

/** \brief Asks the clouds which of many hypotheses is right.
 *
 * All of them are screened on a few points, and the best again on more; the best dozen
 * that differ, and the favourites, are moved onto the target's surface and judged on all
 * that is known. The same on any number of threads.
 * \param[in] hypotheses to be screened, in the centred frames of the problem
 * \param[in] favourites poses that skip the screening
 * \param[in] inlier_distance as in Parameters
 * \return the distinct ones, by evidence, descending; empty if a cloud has no points
 */
std::vector<CheckedPose>
checkOnClouds(const SurfacePair& clouds,
              const Problem& problem,
              const std::vector<Pose>& hypotheses,
              const std::vector<ScoredPose>& favourites,
              float inlier_distance,
              cpu::ThreadPool& pool);

} // namespace pcl_flashreg
