// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "report.h"

#include "../program/pair_text.h"
#include "../program/rounded.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <cmath>
#include <cstdio>
#include <iomanip>

namespace pcl_flashreg::align {
namespace {

using program::plainStream;
using program::rounded;

std::string
formatPose(const RigidTransform& pose)
{
  const Eigen::Matrix4d matrix = pose.toMatrix<double>();
  auto stream = plainStream(12);
  for (int row = 0; row < 4; ++row) {
    stream << ' ';
    for (int column = 0; column < 4; ++column)
      stream << ' ' << std::setw(column < 3 ? 15 : 20) << matrix(row, column);
    stream << '\n';
  }
  return stream.str();
}

std::string
formatCounts(const Outcome& outcome)
{
  const Result& result = outcome.pair.pose;
  std::string text = std::to_string(result.inliers.size()) + " of " +
                     std::to_string(outcome.pair.correspondences) + " correspondences";
  if (result.correspondences_dropped > 0)
    text += ", of which " + std::to_string(result.correspondences_dropped) +
            " were left out (--max-correspondences)";
  if (result.correspondences_invalid > 0)
    text += ", " + std::to_string(result.correspondences_invalid) +
            " were not finite numbers";
  return text;
}

/** \brief The total, and under it the steps that it is made of, in lines of bearable
 * length. */
std::string
formatTimes(const Outcome& outcome)
{
  constexpr std::size_t WIDTH = 88;
  const std::string margin(12, ' ');
  std::string text = "time        " + rounded(outcome.total_ms, 1) + " ms (" +
                     outcome.pair.pose.backend + ")\n";
  std::string line = margin;
  for (const Step& step : stepsOf(outcome)) {
    const std::string time = rounded(step.milliseconds, 1);
    if (time == "0.0" || time == "-0.0")
      continue;
    const std::string item = step.name + (' ' + time);
    if (line.size() + 2 + item.size() > WIDTH) {
      text += line + ",\n";
      line = margin;
    }
    line += (line == margin ? "" : ", ") + item;
  }
  return text + line + '\n';
}

std::string
formatVector(const Eigen::Vector3d& v, int digits)
{
  return "(" + rounded(v.x(), digits) + " " + rounded(v.y(), digits) + " " +
         rounded(v.z(), digits) + ")";
}

/** \brief A line for each motion that the clouds leave free. */
std::string
formatFreeMotions(const Result& result)
{
  std::string text;
  for (const FreeMotion& motion : result.free_motions) {
    const bool turns = motion.kind == FreeMotion::Kind::Turn;
    const double unit = turns ? 180 / 3.14159265358979323846 : 1;
    const int digits = turns ? 0 : 2;
    text += (text.empty() ? "free        may " : "            may ");
    text +=
        (turns ? "turn about " : "slide along ") + formatVector(motion.direction, 2);
    if (turns)
      text += " through " + formatVector(motion.point, 2);
    text += ", from " + rounded(-unit * motion.backward, digits) + " to " +
            rounded(unit * motion.forward, digits) + (turns ? " deg" : "") + '\n';
  }
  return text;
}

} // namespace

std::string
formatVerdict(const Outcome& outcome)
{
  const Result& result = outcome.pair.pose;
  if (result.status != Status::Ok)
    return std::string("no pose found: ") + toString(result.status);
  std::string evidence =
      std::to_string(result.inliers.size()) + " correspondences agree";
  if (result.evidence.has_clouds)
    evidence += ", " + rounded(100 * result.evidence.agreement.matched, 0) +
                " % of the points match";
  evidence += ", confidence " + rounded(result.confidence, 2);
  if (result.converged)
    return "pose found and trusted: " + evidence;
  const std::string want = program::wantOf(result.evidence);
  return "pose found, but NOT trusted: " + evidence +
         " (needed: " + rounded(outcome.pair.parameters.min_confidence, 2) + ")" +
         (want.empty() ? "" : "; " + want);
}

std::string
formatReport(const Options& options, const Outcome& outcome)
{
  std::string text = formatVerdict(outcome) + '\n';
  if (outcome.pair.pose.status == Status::Ok)
    text += "transform, source to target:\n" +
            formatPose(outcome.pair.pose.T_target_source);
  text += formatFreeMotions(outcome.pair.pose);
  text += "inliers     " + formatCounts(outcome) + '\n';
  if (outcome.pair.resolution != 0)
    text += "resolution  " + detail::toText(outcome.pair.resolution) +
            (options.leaf ? "\n" : " (estimated; --leaf sets another)\n");
  if (options.parameters.motion == MotionModel::Upright)
    text += "motion      upright, up to " +
            detail::toText(options.parameters.max_tilt) + " degrees off\n";
  return text + formatTimes(outcome);
}

} // namespace pcl_flashreg::align
