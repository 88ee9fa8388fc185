// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/joint_judgement.h"
#include "multiview/votes.h"

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief Two groups, and what is known of how they lie to each other. */
struct Bond {
  /** \brief Pairs of a scan of the one and a scan of the other. */
  std::vector<const PairVotes*> pairs;
  Placements placements;
  /** \brief How sure the best placement is: the logarithm of its odds; the most it can be, until
   * the clouds were asked. */
  double prospect = 0;
  /** \brief The same by the votes alone, as if pairs erred by themselves. */
  double urgency = 0;
  bool judged = false;

  const Placement&
  best() const
  {
    return placements.best.front();
  }
};

/** \brief The groups of a bond. */
struct BondEnds {
  const std::vector<std::size_t>& fixed;
  const std::vector<std::size_t>& moving;
};

/** \brief Counts the votes of its pairs. */
void
count(Bond& bond, const BondEnds& ends, const MapScans& scans, const MapPoses& poses);

/** \brief Moves one of the placements onto the surfaces and adds what all clouds say. */
void
judge(Placement& placement,
      const BondEnds& ends,
      const MapScans& scans,
      const MapPoses& poses);

/** \brief Ranks the placements, all of which have been judged. */
void
conclude(Bond& bond,
         const BondEnds& ends,
         const MapScans& scans,
         const MapPoses& poses);

} // namespace pcl_flashreg
