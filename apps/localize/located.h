// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/scan_files.h"

#include <pcl_flashreg/result.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::localize {

/** \brief Milliseconds. */
struct LocateTimes {
  double reading = 0, scan = 0, placing = 0, total = 0;
};

/** \brief What a sequence says of one of its scans. */
struct InSequence {
  /** \brief Nothing where the sequence was not found at all. */
  std::optional<RigidTransform> T_map_scan;
  CloudAgreement agreement;
  /** \brief Of the sequence. */
  bool is_trusted = false;
  double confidence = 0;
};

/** \brief A scan, and where it is. */
struct Located {
  program::ScanFile file;
  /** \brief Why it can't be used; empty if it can. */
  std::string error;
  std::size_t keypoints = 0, correspondences = 0;
  /** \brief Of the scan alone; converged if it is trusted, which poses beyond --near are
   * not. */
  Result result;
  /** \brief Of a scan of a sequence, in whose place it counts. */
  std::optional<InSequence> in_sequence;
  /** \brief What people should know of it, a line each. */
  std::vector<std::string> warnings;
  LocateTimes times;

  bool
  isTrusted() const
  {
    return in_sequence ? in_sequence->is_trusted : result.converged;
  }

  bool
  hasPose() const
  {
    return error.empty() && (in_sequence ? in_sequence->T_map_scan.has_value()
                                         : result.status == Status::Ok);
  }

  double
  confidence() const
  {
    return in_sequence ? in_sequence->confidence : result.confidence;
  }

  /** \brief If hasPose(). */
  const RigidTransform&
  T_map_scan() const
  {
    return in_sequence ? *in_sequence->T_map_scan : result.T_target_source;
  }
};

/** \brief Whether the clouds speak for another pose at least half as much as for the pose
 * itself: matched less contradicted. */
bool
isRival(const CloudAgreement& other, const CloudAgreement& pose);

/** \brief Of rivals those that are told, the best. */
constexpr std::size_t MOST_RIVALS = 5;

/** \brief Best first. */
std::vector<Hypothesis>
rivalsOf(const Result& result);

} // namespace pcl_flashreg::localize
