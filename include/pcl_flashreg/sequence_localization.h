// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief A scan of a sequence: scans whose poses to each other are known, as odometry knows
 * them. */
struct SequenceScan {
  Scan scan;
  /** \brief In the sequence's own frame. */
  RigidTransform T_sequence_scan;
  /** \brief What PairRegistration::align() found of the scan alone in the map, with
   * forSequence(): its hypotheses are where the sequence is looked for. */
  Result alone;
};

/** \brief A way in which a sequence may lie in a map. */
struct SequencePlacement {
  /** \brief map = rotation * sequence + translation: what fits best to the poses of the
   * scans. */
  RigidTransform T_map_sequence;
  /** \brief Of each scan: where the sequence puts it, moved onto the surfaces of the map. */
  std::vector<RigidTransform> T_map_scan;
  /** \brief Of all scans together, as they see it, and of each. */
  CloudAgreement agreement;
  std::vector<CloudAgreement> agreement_of_scan;
  /** \brief Scans that have this pose among their own hypotheses, and the correspondences of
   * theirs that agree with it. */
  std::size_t supporters = 0;
  double inliers = 0;
};

/** \brief What localizeSequence() returns. */
struct SequenceResult {
  /** \brief The verdict: there is a placement, and confidence is at least
   * Parameters::min_confidence. */
  bool converged = false;
  /** \brief Probability that the first placement is right, as that of a scan in a map, on the
   * evidence of all scans together. */
  double confidence = 0;
  Evidence evidence;
  /** \brief Distinct ones, best first; the others are its rivals. Empty if no scan has any
   * hypothesis. */
  std::vector<SequencePlacement> placements;
  /** \brief Motions of the whole sequence that the clouds leave free, in the map's frame. */
  std::vector<FreeMotion> free_motions;
};

/** \brief The options under which scans tell of all places where they may be. */
PCL_FLASHREG_EXPORT PairOptions
forSequence(PairOptions options);

/** \brief Finds a sequence of scans in a map, where one scan alone may be ambiguous: whatever
 * any of its scans was found to be is a hypothesis for all, and all their clouds judge it.
 *
 * Scans are in the order in which they were made. The poses within the sequence may drift: what
 * counts is that they lead from each scan to the next to within two spacings and ten degrees.
 * The same result on any number of threads.
 * \param[in] num_threads 0 takes as many as there are processors
 * \throws std::invalid_argument if an option is out of range, or a pose is not finite
 */
PCL_FLASHREG_EXPORT SequenceResult
localizeSequence(const std::vector<SequenceScan>& scans,
                 const ScanIndex& map,
                 const PairOptions& options = {},
                 unsigned num_threads = 0);

} // namespace pcl_flashreg
