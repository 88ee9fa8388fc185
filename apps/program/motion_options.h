// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/parameters.h>

#include <CLI/CLI.hpp>

#include <optional>
#include <string>

namespace pcl_flashreg::program {

/** \brief What the options say of the motion model; they are read once all are parsed. */
struct MotionWords {
  bool upright = false;
  /** \brief "x,y,z", of all clouds, and of one alone. */
  std::optional<std::string> gravity, source_gravity, target_gravity;
  std::optional<float> max_tilt;
  /** \brief What the program calls them: --gravity-NAME. */
  std::string source_name = "source", target_name = "target";
};

/** \brief --upright, --gravity and --max-tilt. */
void
addMotion(CLI::App& app, const std::string& group, MotionWords& words);

/** \brief --gravity-source and --gravity-target, or as `words` names them, for clouds in
 * frames of their own. */
void
addGravityOfEach(CLI::App& app, const std::string& group, MotionWords& words);

/** \brief Sets the fields of the motion model.
 * \throws UsageError with one line that says what is wrong with the options */
void
takeMotion(const MotionWords& words, Parameters& parameters);

/** \brief For files: "rigid" or "upright". */
const char*
nameOf(MotionModel motion);

} // namespace pcl_flashreg::program
