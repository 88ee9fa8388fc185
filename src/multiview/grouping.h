// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/joint_judgement.h"
#include "multiview/votes.h"
#include "support/thread_pool.h"

namespace pcl_flashreg {

/** \brief Scans, in groups whose scans have poses in one frame. */
struct Grouping {
  /** \brief Ascending numbers. */
  std::vector<std::vector<std::size_t>> groups;
  MapPoses poses;
};

/** \brief Joins groups, from scans that are alone, as long as two of them are certain to lie
 * in some way to each other: the surest first, so that later ones have more pairs to go by
 * and more clouds to judge them.
 * \param[in] start the groups to begin with
 * \param[in] min_confidence of a placement */
Grouping
joinGroups(const MapScans& scans,
           const std::vector<PairVotes>& pairs,
           Grouping start,
           double min_confidence,
           ThreadPool& pool);

/** \brief Of each scan, how sure it is that all others of its group would put it where it is, and
 * no other group would put it anywhere; 0 of one that is alone. */
std::vector<double>
confidencesOf(const MapScans& scans,
              const std::vector<PairVotes>& pairs,
              const Grouping& map,
              ThreadPool& pool);

/** \brief Takes scans out of their groups that are not sure of their places any more; what only
 * they tied together falls apart.
 * \param[in] confidences of the scans in this map
 * \param[in] least_confidence of a scan that stays */
void
releaseDoubtful(const MapScans& scans,
                const std::vector<PairVotes>& pairs,
                const std::vector<double>& confidences,
                double least_confidence,
                Grouping& map);

} // namespace pcl_flashreg
