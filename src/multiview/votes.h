// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/map_scan.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief One pose that a pair speaks for. */
struct Vote {
  double probability;
  /** \brief Between the middles of the scans. */
  Eigen::Isometry3d T_target_source;
};

/** \brief A pair of scans, and the poses that it speaks for, the most probable first. */
struct PairVotes {
  std::size_t target, source;
  std::vector<Vote> votes;

  /** \brief That none of its poses is right. */
  double
  unsure() const;
};

/** \brief What relations say, by target and source, the target having the smaller number. Of a
 * pair that was asked both ways each counts by half. */
std::vector<PairVotes>
votesOf(const std::vector<ScanRelation>& relations, const std::vector<MapScan>& scans);

/** \brief A way in which two groups may lie to each other. */
struct Placement {
  Eigen::Isometry3d T_fixed_moving = Eigen::Isometry3d::Identity();
  /** \brief Logarithm of how likely it is, by the votes; only differences count. */
  double votes = 0;
  /** \brief JointAgreement::harmony() on the surfaces; the most it can be, until the clouds
   * were asked. */
  double harmony = 0;
  /** \brief Pairs that speak for it. */
  std::size_t supporters = 0;
};

struct Placements {
  /** \brief The likeliest first, each another one. */
  std::vector<Placement> best;
  /** \brief The votes for there being none that any pair speaks for. */
  double none = 0;
};

/** \brief Counts what pairs between two groups say.
 *
 * Each pair holds that its k-th pose is right with probability p_k, and that with p_0 none is.
 * A wrong pose agrees with a placement by chance, with density rho. By Bayes, placement X has
 * the odds rho * prod (sum of p_k that agree with X + p_0 rho) / rho. But pairs that see the
 * same place err together, so that only the strongest one counts in full.
 * \param[in] pairs between the groups; which of both scans is the target makes no difference
 * \param[in] is_moving whether a scan is of the moving group
 * \param[in] most placements */
Placements
countVotes(const std::vector<const PairVotes*>& pairs,
           const std::vector<bool>& is_moving,
           const MapPoses& poses,
           double spacing,
           std::size_t most);

} // namespace pcl_flashreg
