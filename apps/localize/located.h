// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/scan_files.h"

#include <pcl_flashreg/result.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::localize {

/** \brief Milliseconds. */
struct LocateTimes {
  double reading = 0, scan = 0, placing = 0, total = 0;
};

/** \brief A scan, and where it is. */
struct Located {
  program::ScanFile file;
  /** \brief Why it can't be used; empty if it can. */
  std::string error;
  std::size_t keypoints = 0, correspondences = 0;
  /** \brief Of T_map_scan; converged if it is trusted, which poses beyond --near are
   * not. */
  Result result;
  /** \brief What people should know of it, a line each. */
  std::vector<std::string> warnings;
  LocateTimes times;

  bool
  isTrusted() const
  {
    return result.converged;
  }

  bool
  hasPose() const
  {
    return error.empty() && result.status == Status::Ok;
  }

  const RigidTransform&
  T_map_scan() const
  {
    return result.T_target_source;
  }
};

/** \brief The other poses that the clouds speak for at least half as much as for the
 * pose itself: matched less contradicted. Best first, five at most. */
std::vector<Hypothesis>
rivalsOf(const Result& result);

} // namespace pcl_flashreg::localize
