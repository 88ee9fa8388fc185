// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "repetition.h"

#include <pcl_flashreg/parameters.h>

#include <CLI/CLI.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief What the command line says. Empty lists stand for the defaults of the backend,
 * see fillIn(). */
struct Options {
  std::string backend = "auto";
  std::vector<std::size_t> sizes;
  std::vector<double> inlier_ratios = {0.05};
  double side = 3;
  double leaf = 0.05;
  std::vector<std::string> files;
  std::vector<std::string> second_order;
  unsigned threads = 0;
  /** \brief No runs stand for the backend's default. */
  Repetition repetition{0};
  std::vector<unsigned> side_by_side;

  // On a device.
  double energy_seconds = 2;
  bool ablation = false;

  std::string json;
  std::string export_folder;
};

void
declareOptions(CLI::App& app, Options& options);

/** \brief Replaces what was not given by what suits the backend: on a device more runs,
 * larger problems, and both forms of stage 2.
 * \param[in] on_device the backend in use is the one of a device
 */
void
fillIn(Options& options, bool on_device);

/** \param[in] second_order one of Options::second_order */
Parameters
parametersOf(const Options& options, const std::string& second_order);

} // namespace pcl_flashreg::benchmark
