// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/program.h"

#include <pcl_flashreg/pair_registration.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::align {

using program::UsageError;

/** \brief The command line of pcl_flashreg_align; an empty path is one not given. */
struct Options {
  std::string source;
  std::string target;
  std::string output;

  /** \brief One file (of six columns, or of index pairs), two files (of three), or
   * none. */
  std::vector<std::string> correspondences;
  /** \brief Two files of descriptors, or none. */
  std::vector<std::string> features;
  /** \brief Where no descriptors are given: by PCL instead of by this project. */
  bool pcl_features = false;
  std::string guess;
  /** \brief float32 values in a row of raw .bin files; 0 to tell it from the values. */
  std::size_t bin_fields = 0;

  std::string json;
  std::string transform;
  std::string snapshot;
  bool view = false;
  bool quiet = false;
  bool write_untrusted = false;

  std::optional<double> leaf;
  std::optional<float> length_tolerance;
  std::optional<float> min_length_sum;
  std::optional<float> inlier_distance;
  /** \brief Everything but the lengths. */
  Parameters parameters;

  std::size_t neighbors = 1;
  bool mutual = false;
  /** \brief Leave the clouds out of the decision which pose is right. */
  bool fast = false;
  bool second_look = true;
  /** \brief Whether the sensor stood at the VIEWPOINT of its cloud. */
  bool source_viewpoint_known = true;
  bool target_viewpoint_known = true;
  BackendKind backend = BackendKind::Auto;
  unsigned threads = 0;

  /** \brief All but what comes from files. */
  PairOptions
  pairOptions() const;
};

/** \brief Parses the command line and checks what can be checked without reading a
 * file's contents.
 * \return nothing if help or the version was asked for, and printed
 * \throws UsageError with one line that says what is wrong
 */
std::optional<Options>
parseOptions(int argc, char** argv);

} // namespace pcl_flashreg::align
