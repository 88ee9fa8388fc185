// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "doubts.h"

#include "../program/pair_text.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::align {
namespace {

std::string
leftOut(std::size_t count)
{
  return count == 1 ? "1 point is left out that lies "
                    : std::to_string(count) + " points are left out that lie ";
}

void
noteLeftOut(const std::string& path,
            const LeftOutPoints& left_out,
            const Messages& messages)
{
  if (left_out.repeated > 0)
    messages.note(path + ": " + leftOut(left_out.repeated) +
                  "in one place, most of them at " +
                  program::vectorText(left_out.place) + ": beams without a return?");
  if (left_out.stray > 0)
    messages.note(path + ": " + leftOut(left_out.stray) +
                  "beyond all others by orders of magnitude");
}

void
noteViewpoint(const InputCloud& cloud,
              const Scan& scan,
              bool stated,
              const Messages& messages)
{
  const std::string doubt =
      program::viewpointDoubt(scan, Eigen::Vector3d(cloud.cloud.viewpoint.data()));
  if (stated && !doubt.empty())
    messages.note(cloud.path + ": " + doubt);
}

void
noteFlatness(const std::string& path, const Scan& scan, const Messages& messages)
{
  const std::string doubt = program::flatnessDoubt(scan);
  if (!doubt.empty())
    messages.note(path + ": " + doubt);
}

/** \brief Factors between units that people mix up: feet and metres, inches and
 * centimetres, and so on. */
constexpr double UNITS[] = {
    2.54, 3.28084, 10, 12, 25.4, 30.48, 39.3701, 100, 304.8, 1000};

/** \brief How much a ratio is off a factor, in either direction. */
double
offBy(double ratio, double factor)
{
  return std::abs(std::log(ratio / factor));
}

/** \brief Whether the spacing of the points and the size of the clouds differ both by what
 * one unit is in another; scans of one place differ in neither so much. */
bool
lookLikeTwoUnits(double resolutions, double extents)
{
  constexpr double TOLERANCE = 0.3;
  if (resolutions < 1) {
    resolutions = 1 / resolutions;
    extents = 1 / extents;
  }
  return std::any_of(std::begin(UNITS), std::end(UNITS), [&](double factor) {
    return offBy(resolutions, factor) < TOLERANCE && offBy(extents, factor) < TOLERANCE;
  });
}

struct Estimates {
  double source = 0, target = 0;
};

double
medianOf(std::vector<double>& values)
{
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/** \brief Median distance from the middle; of all points but those that were left out. */
double
extentOf(const InputCloud& cloud, const LeftOutPoints& left_out)
{
  const auto is_used = [&](const Eigen::Vector3d& point) {
    return point.allFinite() && (left_out.repeated == 0 || point != left_out.place);
  };
  Eigen::Vector3d middle;
  std::vector<double> values;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    values.clear();
    for (const auto& point : cloud.xyz.colwise())
      if (is_used(point))
        values.push_back(point[axis]);
    middle[axis] = medianOf(values);
  }
  values.clear();
  for (const auto& point : cloud.xyz.colwise())
    if (is_used(point))
      values.push_back((point - middle).norm());
  return medianOf(values);
}

/** \brief The registration's, or where it had a resolution, those that it would have made. */
std::optional<Estimates>
estimatesOf(const Inputs& inputs, const PairResult& result)
{
  if (result.source_estimate && result.target_estimate)
    return Estimates{*result.source_estimate, *result.target_estimate};
  try {
    return Estimates{io::resolutionOf(*inputs.source),
                     io::resolutionOf(*inputs.target)};
  }
  catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

void
noteUnits(const Inputs& inputs, const PairResult& result, const Messages& messages)
{
  constexpr double FAR_APART = 5;
  const std::optional<Estimates> estimates = estimatesOf(inputs, result);
  if (!estimates)
    return;
  const double resolutions = estimates->source / estimates->target;
  const double extents = extentOf(*inputs.source, result.source_left_out) /
                         extentOf(*inputs.target, result.target_left_out);
  if (std::abs(std::log(resolutions)) > std::log(FAR_APART) ||
      lookLikeTwoUnits(resolutions, extents))
    messages.note("the source by itself would be seen at a resolution of " +
                  detail::toText(estimates->source) + ", the target at " +
                  detail::toText(estimates->target) + ": are both in the same unit?");
}

} // namespace

void
noteDoubts(const Options& options,
           const Inputs& inputs,
           const PairResult& result,
           const Messages& messages)
{
  if (!inputs.source || !inputs.target)
    return;
  noteLeftOut(inputs.source->path, result.source_left_out, messages);
  noteLeftOut(inputs.target->path, result.target_left_out, messages);
  if (result.source.empty() || result.target.empty())
    return;
  noteViewpoint(
      *inputs.source, result.source, options.source_viewpoint_known, messages);
  noteViewpoint(
      *inputs.target, result.target, options.target_viewpoint_known, messages);
  if (result.pose.converged)
    return;
  noteFlatness(inputs.source->path, result.source, messages);
  noteFlatness(inputs.target->path, result.target, messages);
  if (!inputs.source_features && !inputs.correspondences)
    noteUnits(inputs, result, messages);
}

} // namespace pcl_flashreg::align
