// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../batch/shard.h"
#include "../program/program.h"
#include "../program/pose_format.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

using program::PoseFormat;
using program::UsageError;

/** \brief The command line of pcl_flashreg_map; an empty path is one not given. */
struct Options {
  /** \brief Folders and files, as typed. */
  std::vector<std::string> scans;
  /** \brief A text file with the path of a scan a line. */
  std::string list;
  /** \brief Whether a scan that can't be used ends the run. */
  bool strict = false;
  /** \brief float32 values in a row of raw .bin files; 0 to tell it from the values. */
  std::size_t bin_fields = 0;
  /** \brief Whether sensors stood at the VIEWPOINT of their clouds. */
  bool viewpoint_known = true;

  /** \brief The merged cloud. */
  std::string output;
  /** \brief Edge of its voxels. */
  std::optional<double> map_leaf;
  std::string poses;
  PoseFormat pose_format = PoseFormat::Tum;
  std::string graph;
  std::string json;
  /** \brief The map from above. */
  std::string picture;
  /** \brief What was done and how far to trust it, as Markdown. */
  std::string page;
  /** \brief Groups but the largest are not written. */
  bool largest_only = false;
  bool quiet = false;

  std::optional<double> leaf;
  double min_confidence = MultiviewOptions().min_confidence;
  bool sequence = false;
  /** \brief Which motions a scan's pose may be; nothing else of it is used. */
  Parameters motion;
  unsigned threads = 0;
  /** \brief Where scans are kept that don't fit into memory. */
  std::string scan_folder;

  /** \brief What pairs say; empty to keep it in memory alone. */
  std::string pairs;
  bool resume = false;
  bool add = false;
  /** \brief Nothing: the whole work. */
  std::optional<batch::Shard> shard;

  /** \brief Options as typed, for those who read of the run later. */
  std::vector<std::string> typed;

  MultiviewOptions
  multiview() const;
};

/** \brief Parses the command line and checks what can be checked without reading a file's
 * contents.
 * \return nothing if help or the version was asked for, and printed
 * \throws UsageError with one line that says what is wrong
 */
std::optional<Options>
parseOptions(int argc, char** argv);

} // namespace pcl_flashreg::map
