// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/messages.h"
#include "map_run.h"
#include "options.h"
#include "scan_store.h"

#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief The scans of a run, as they were read. */
struct ScanSet {
  std::vector<ScanFile> files;
  /** \brief Of the contents of the files: a scan is the same whatever its name. */
  std::vector<std::string> checksums;
  std::vector<LeftOutFile> left_out;
  double resolution = 0;
  /** \brief Whether the clouds say so. */
  bool estimated = false;
};

/** \brief Makes scans of all files, one file in memory at a time. Files that are no clouds,
 * hold too few points or the same as another are named and left out.
 * \param[in] resolution where it is known; else the middle one of those that the clouds
 * would be seen at by themselves
 * \param[out] store gets the scans, numbered as ScanSet::files
 * \throws io::InputError if fewer than two scans remain, or with Options::strict if one is
 * left out
 */
ScanSet
readScans(const Options& options,
          const std::vector<ScanFile>& files,
          std::optional<double> resolution,
          const program::Messages& messages,
          ScanStore& store);

} // namespace pcl_flashreg::map
