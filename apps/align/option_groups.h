// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/motion_options.h"
#include "options.h"

#include <CLI/CLI.hpp>

#include <map>
#include <string>

namespace pcl_flashreg::align {

/** \brief The options whose text needs a second look once all are parsed. */
struct Words {
  std::string correspondences;
  std::string features;
  std::string second_order = "auto";
  std::string score = "inliers";
  std::string backend = "auto";
  std::string no_viewpoint;
  program::MotionWords motion;
};

/** \brief The values that --second-order and --score take. */
extern const std::map<std::string, SecondOrder> kSecondOrders;
extern const std::map<std::string, ScoreMetric> kScores;

/** \brief Declares all options and positionals, with their help. */
void
addOptions(CLI::App& app, Options& options, Words& words);

} // namespace pcl_flashreg::align
