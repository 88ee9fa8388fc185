// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "motion_options.h"

#include "../io/text.h"
#include "help_text.h"
#include "program.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <vector>

namespace pcl_flashreg::program {
namespace {

std::array<float, 3>
directionOf(const std::string& text, const std::string& option)
{
  std::array<float, 3> direction{};
  const std::optional<std::vector<double>> numbers = io::numbersIn(text);
  const bool is_direction = numbers && numbers->size() == direction.size();
  for (std::size_t i = 0; is_direction && i < direction.size(); ++i)
    direction[i] = static_cast<float>((*numbers)[i]);
  const float length = std::hypot(direction[0], direction[1], direction[2]);
  if (!(length > 0) || !std::isfinite(length))
    throw UsageError(option + ": expected a direction, X,Y,Z, found '" + text + "'");
  return direction;
}

/** \brief What is said of upright motions, of which nothing was said. */
std::string
saidForNothing(const MotionWords& words)
{
  if (words.gravity)
    return "--gravity";
  if (words.source_gravity)
    return "--gravity-" + words.source_name;
  if (words.target_gravity)
    return "--gravity-" + words.target_name;
  return words.max_tilt ? "--max-tilt" : "";
}

} // namespace

void
addMotion(CLI::App& app, const std::string& group, MotionWords& words)
{
  app.add_flag("--upright",
               words.upright,
               wrapped("It is known which way is up: only poses that keep it so"))
      ->group(group);
  app.add_option("--gravity",
                 words.gravity,
                 wrapped("With --upright: the direction of gravity in the clouds, or "
                         "the opposite one (default: 0,0,1)"))
      ->type_name("X,Y,Z")
      ->group(group);
  app.add_option("--max-tilt",
                 words.max_tilt,
                 wrapped("With --upright: how many degrees gravity may be off, at most "
                         "30 (default: " +
                         detail::toText(Parameters().max_tilt) + ")"))
      ->type_name("DEGREES")
      ->group(group);
}

void
addGravityOfEach(CLI::App& app, const std::string& group, MotionWords& words)
{
  app.add_option("--gravity-" + words.source_name,
                 words.source_gravity,
                 wrapped("The same of the " + words.source_name + " alone"))
      ->type_name("X,Y,Z")
      ->group(group);
  app.add_option("--gravity-" + words.target_name,
                 words.target_gravity,
                 wrapped("The same of the " + words.target_name + " alone"))
      ->type_name("X,Y,Z")
      ->group(group);
}

void
takeMotion(const MotionWords& words, Parameters& parameters)
{
  const std::string for_nothing = saidForNothing(words);
  if (!words.upright && !for_nothing.empty())
    throw UsageError(for_nothing + ": says nothing without --upright");
  if (!words.upright)
    return;
  parameters.motion = MotionModel::Upright;
  if (words.gravity)
    parameters.source_gravity = parameters.target_gravity =
        directionOf(*words.gravity, "--gravity");
  if (words.source_gravity)
    parameters.source_gravity =
        directionOf(*words.source_gravity, "--gravity-" + words.source_name);
  if (words.target_gravity)
    parameters.target_gravity =
        directionOf(*words.target_gravity, "--gravity-" + words.target_name);
  parameters.max_tilt = words.max_tilt.value_or(parameters.max_tilt);
  try {
    parameters.validate();
  }
  catch (const std::invalid_argument& error) {
    throw UsageError(asOption(error.what()));
  }
}

const char*
nameOf(MotionModel motion)
{
  return motion == MotionModel::Upright ? "upright" : "rigid";
}

} // namespace pcl_flashreg::program
