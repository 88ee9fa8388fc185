// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "report.h"

#include "../io/csv.h"
#include "../io/pose_io.h"
#include "../program/pair_text.h"
#include "../program/rounded.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::localize {
namespace {

using program::Json;
using program::rounded;

constexpr double DEGREES = 180 / 3.14159265358979323846;

/** \brief The turn about the map's upright, where the scan is about level in it; the
 * whole turn where it is not. */
std::string
headingText(const RigidTransform& pose, const Parameters& parameters)
{
  constexpr double LEVEL = 30;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  if (parameters.motion == MotionModel::Upright)
    up = Eigen::Map<const Eigen::Vector3f>(parameters.target_gravity.data())
             .cast<double>()
             .normalized();
  // What is given may be the direction of gravity or the opposite one.
  if (up.z() < 0)
    up = -up;
  const Eigen::Quaterniond q = io::quaternionOf(pose);
  const double tilt = std::acos(std::clamp((pose.rotation * up).dot(up), -1.0, 1.0));
  if (tilt * DEGREES > LEVEL)
    return "turned by " + rounded(Eigen::AngleAxisd(q).angle() * DEGREES, 1) + " deg";
  const double heading = 2 * std::atan2(q.vec().dot(up), q.w());
  return "heading " + rounded(heading * DEGREES, 1) + " deg";
}

std::string
positionText(const Eigen::Vector3d& at, double spacing)
{
  const int digits =
      std::clamp(static_cast<int>(std::ceil(0.5 - std::log10(spacing))), 0, 9);
  std::string text;
  for (const double value : {at.x(), at.y(), at.z()}) {
    const double unit = std::pow(10, -digits);
    const bool is_zero = std::abs(value) < 0.5 * unit; // which has no sign
    text += (text.empty() ? "(" : " ") + rounded(is_zero ? 0 : value, digits);
  }
  return text + ")";
}

std::string
countOf(std::size_t count, const std::string& what)
{
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string
reasonText(const Located& located, double spacing)
{
  if (!located.hasPose())
    return located.warnings.empty() ? toString(located.result.status)
                                    : located.warnings.back();
  std::string text = "best guess " +
                     positionText(located.T_map_scan().translation, spacing) +
                     " with confidence " + rounded(located.confidence(), 2);
  // Of a sequence all that is said of it once.
  if (located.in_sequence)
    return text;
  const std::string want = program::wantOf(located.result.evidence);
  if (!want.empty())
    text += "; " + want;
  const std::size_t rivals = rivalsOf(located.result).size();
  if (rivals > 0)
    text += " (" + countOf(rivals, "rival") + ")";
  for (const std::string& warning : located.warnings)
    text += "; " + warning;
  return text;
}

double
medianTime(const std::vector<Located>& all)
{
  std::vector<double> times;
  for (const Located& located : all)
    if (located.error.empty())
      times.push_back(located.times.total);
  if (times.empty())
    return 0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

std::vector<io::PosedScan>
trustedPoses(const std::vector<Located>& all)
{
  std::vector<std::string> paths;
  for (const Located& located : all)
    paths.push_back(located.file.path);
  const std::vector<std::string> numbers = io::numbersOf(paths);
  std::vector<io::PosedScan> posed;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].isTrusted())
      posed.push_back({numbers[i], all[i].file.name, all[i].T_map_scan()});
  return posed;
}

std::string
formatCsv(const std::vector<Located>& all)
{
  const std::vector<std::string> columns{
      "name", "trusted", "confidence", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
  std::string text = io::joinCsv(columns) + '\n';
  for (const Located& located : all) {
    std::vector<std::string> cells{io::inOneLine(located.file.name),
                                   located.isTrusted() ? "1" : "0",
                                   io::numberText(located.confidence())};
    if (located.isTrusted())
      for (const std::string& cell : io::poseCells(located.T_map_scan()))
        cells.push_back(cell);
    cells.resize(columns.size());
    text += io::joinCsv(cells) + '\n';
  }
  return text;
}

} // namespace

std::string
formatPlace(const Located& located, const Options& options, double spacing)
{
  const std::string time = ", " + rounded(located.times.total, 0) + " ms";
  if (!located.isTrusted())
    return located.file.name + ": not found: " + reasonText(located, spacing) + time;
  std::string text = located.file.name + ": at " +
                     positionText(located.T_map_scan().translation, spacing) + ", " +
                     headingText(located.T_map_scan(), options.parameters) +
                     ", confidence " + rounded(located.confidence(), 2) + time;
  for (const std::string& warning : located.warnings)
    text += "; " + warning;
  return text;
}

std::string
formatSequence(const LocatedSequence& sequence, const Options& options, double spacing)
{
  const SequenceResult& result = sequence.result;
  const std::string name =
      sequence.file + ": sequence of " + countOf(sequence.scans, "scan");
  const std::string time = ", " + rounded(sequence.placing, 0) + " ms";
  if (result.placements.empty())
    return name + ": not found" + time;
  const SequencePlacement& best = result.placements.front();
  std::string text = name +
                     (sequence.isTrusted() ? ": at " : ": not found: best guess ") +
                     positionText(best.T_map_sequence.translation, spacing) + ", " +
                     headingText(best.T_map_sequence, options.parameters) +
                     ", confidence " + rounded(result.confidence, 2) + ", " +
                     std::to_string(best.supporters) + " could be there by themselves";
  const std::string want = program::wantOf(result.evidence);
  if (!sequence.isTrusted() && !want.empty())
    text += "; " + want;
  const std::size_t rivals = rivalsOf(result).size();
  if (!sequence.isTrusted() && rivals > 0)
    text += " (" + countOf(rivals, "rival") + ")";
  for (const std::string& warning : sequence.warnings)
    text += "; " + warning;
  return text + time;
}

std::string
formatCaption(const std::vector<Located>& all)
{
  const auto count = [&](const auto& is_meant) {
    return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_meant));
  };
  const std::size_t unusable =
      count([](const Located& located) { return !located.error.empty(); });
  std::string text = std::to_string(count(
                         [](const Located& located) { return located.isTrusted(); })) +
                     " of " + std::to_string(all.size()) + " placed";
  if (unusable > 0)
    text += ", " + std::to_string(unusable) + " not usable";
  return text;
}

std::string
formatTotal(const std::vector<Located>& all)
{
  return formatCaption(all) + ", median " + rounded(medianTime(all), 0) + " ms";
}

std::string
formatPoses(const std::vector<Located>& all, PoseFormat format)
{
  switch (format) {
  case PoseFormat::Tum:
    return io::formatTum(trustedPoses(all));
  case PoseFormat::Kitti:
    return io::formatKitti(trustedPoses(all));
  case PoseFormat::Csv:
    return formatCsv(all);
  case PoseFormat::AsJson:
    break;
  }
  Json list = Json::array();
  for (const Located& located : all) {
    list.push_back(jsonOf(located));
    list.back().erase("timings_ms");
  }
  return program::textOf(list);
}

} // namespace pcl_flashreg::localize
