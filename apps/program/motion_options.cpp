// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "motion_options.h"

#include "../io/text.h"
#include "help_text.h"
#include "program.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <array>
#include <cmath>
#include <stdexcept>

namespace pcl_flashreg::program {
namespace {

std::array<float, 3>
directionOf(const std::string& text, const std::string& option)
{
  std::array<float, 3> direction{};
  std::string_view rest = text;
  std::size_t count = 0;
  for (;; ++count) {
    const std::size_t comma = rest.find(',');
    double value = 0;
    if (count == direction.size() || !io::parseDouble(rest.substr(0, comma), value))
      break;
    direction[count] = static_cast<float>(value);
    if (comma == std::string_view::npos) {
      ++count;
      break;
    }
    rest.remove_prefix(comma + 1);
  }
  const float length = std::hypot(direction[0], direction[1], direction[2]);
  if (count != direction.size() || !(length > 0) || !std::isfinite(length))
    throw UsageError(option + ": expected a direction, X,Y,Z, found '" + text + "'");
  return direction;
}

/** \brief What is said of upright motions, of which nothing was said. */
const char*
saidForNothing(const MotionWords& words)
{
  if (!words.gravity.empty())
    return "--gravity";
  if (!words.source_gravity.empty())
    return "--gravity-source";
  if (!words.target_gravity.empty())
    return "--gravity-target";
  return words.max_tilt ? "--max-tilt" : nullptr;
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
  app.add_option("--gravity-source",
                 words.source_gravity,
                 wrapped("The same of the source alone"))
      ->type_name("X,Y,Z")
      ->group(group);
  app.add_option("--gravity-target",
                 words.target_gravity,
                 wrapped("The same of the target alone"))
      ->type_name("X,Y,Z")
      ->group(group);
}

void
takeMotion(const MotionWords& words, Parameters& parameters)
{
  const char* for_nothing = saidForNothing(words);
  if (!words.upright && for_nothing)
    throw UsageError(std::string(for_nothing) + ": says nothing without --upright");
  if (!words.upright)
    return;
  parameters.motion = MotionModel::Upright;
  if (!words.gravity.empty())
    parameters.source_gravity = parameters.target_gravity =
        directionOf(words.gravity, "--gravity");
  if (!words.source_gravity.empty())
    parameters.source_gravity = directionOf(words.source_gravity, "--gravity-source");
  if (!words.target_gravity.empty())
    parameters.target_gravity = directionOf(words.target_gravity, "--gravity-target");
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
