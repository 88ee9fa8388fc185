// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "groups.h"
#include "../program/scan_files.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

using program::ScanFile;

/** \brief A file that is no part of the map, and why. */
struct LeftOutFile {
  std::string path;
  std::string reason;
};

/** \brief A merged cloud that was written. */
struct WrittenCloud {
  std::string path;
  std::size_t points = 0;
};

/** \brief Milliseconds. */
struct MapTimes {
  double reading = 0, relations = 0, placing = 0, writing = 0, total = 0;
};

/** \brief A run and its outcome, for those who report it. */
struct MapRun {
  std::vector<ScanFile> scans;
  std::vector<LeftOutFile> left_out;
  double resolution = 0;
  /** \brief Whether the clouds say so, and not the user. */
  bool resolution_estimated = false;
  double min_confidence = 0;
  MotionModel motion = MotionModel::Rigid;
  /** \brief Pairs of scans that were tried, and those of them that an earlier run had. */
  std::size_t pairs = 0, known_pairs = 0;
  MultiviewResult result;
  std::vector<WrittenCloud> clouds;
  MapTimes times;
};

/** \brief Of the scans. */
std::vector<std::string>
namesOf(const MapRun& run);

} // namespace pcl_flashreg::map
