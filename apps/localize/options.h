// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/pose_format.h"
#include "../program/program.h"

#include <pcl_flashreg/pair_registration.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::localize {

using program::PoseFormat;
using program::UsageError;

/** \brief Where scans are known to have been made. */
struct Near {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius = 0;
};

/** \brief The command line of pcl_flashreg_localize; an empty path is one not given. */
struct Options {
  std::string map;
  /** \brief Folders and files, as typed. */
  std::vector<std::string> scans;
  /** \brief A text file with the path of a scan a line. */
  std::string list;
  /** \brief float32 values in a row of raw .bin files; 0 to tell it from the values. */
  std::size_t bin_fields = 0;
  /** \brief Whether sensors stood at the VIEWPOINT of the scans; of a map none did. */
  bool viewpoint_known = true;
  /** \brief Where the index of the map is kept. */
  std::string index;
  /** \brief Whether to read all of an index at once and compare its checksum. */
  bool verify = false;

  /** \brief Poses of the scans to each other, which are looked for together. */
  std::string sequence;

  /** \brief A pose that is tried for every scan, or of the sequence; or the file that it is
   * in. */
  std::optional<RigidTransform> guess;
  std::string guess_file;
  std::optional<Near> near;

  std::string poses;
  PoseFormat pose_format = PoseFormat::Tum;
  /** \brief The map from above, and the scans in it. */
  std::string picture;
  bool quiet = false;

  std::optional<double> leaf;
  bool second_look = true;
  /** \brief Everything but the lengths. */
  Parameters parameters;
  BackendKind backend = BackendKind::Auto;
  unsigned threads = 0;
};

/** \brief Parses the command line and checks what can be checked without reading a
 * file's contents.
 * \return nothing if help or the version was asked for, and printed
 * \throws UsageError with one line that says what is wrong
 */
std::optional<Options>
parseOptions(int argc, char** argv);

} // namespace pcl_flashreg::localize
