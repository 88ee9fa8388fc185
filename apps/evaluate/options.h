// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../batch/shard.h"
#include "../program/program.h"
#include "datasets/data_set.h"
#include "features/descriptors.h"

#include <pcl_flashreg/parameters.h>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

using program::UsageError;

/** \brief The command line of pcl_flashreg_evaluate; an empty path is one not given. */
struct Options {
  std::string data;
  DataSetOptions data_options;
  /** \brief Only these; all if empty. */
  std::vector<std::string> datasets;
  std::size_t every = 1;
  batch::Shard shard;

  std::vector<std::string> methods = {"flashreg"};
  std::optional<double> leaf, max_rotation, max_translation;
  std::size_t neighbors = 1;
  Descriptors descriptors = Descriptors::Native;
  /** \brief As typed. */
  std::string descriptors_name = "fpfh";
  ScoreMetric score = ScoreMetric::Inliers;
  /** \brief As typed. */
  std::string score_name = "inliers";
  unsigned threads = 0;
  std::string cache;

  std::string csv;
  std::string json;
  bool resume = false;
  bool quiet = false;

  /** \brief Files of results to put together, instead of an evaluation. */
  std::vector<std::string> merge;
};

/** \brief Parses the command line.
 * \return nothing if help or the version was asked for, and printed
 * \throws UsageError with one line that says what is wrong
 */
std::optional<Options>
parseOptions(int argc, char** argv);

} // namespace pcl_flashreg::evaluate
