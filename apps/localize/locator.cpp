// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "locator.h"

#include "../io/error.h"
#include "../program/pair_text.h"
#include "../program/rounded.h"
#include "input_scan.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>
#include <pcl_flashreg/sequence_localization.h>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::localize {
namespace {

/** \brief Hypotheses that are asked for: five beside the pose. */
constexpr int HYPOTHESES = 6;

PairOptions
pairOptions(const Options& options, const std::optional<RigidTransform>& guess)
{
  PairOptions result;
  result.parameters = options.parameters;
  result.parameters.max_hypotheses = HYPOTHESES;
  result.second_look = options.second_look;
  result.guess = guess;
  return result;
}

/** \brief How far the keypoints are from the origin of the scan's frame, at most. */
double
reachOf(const Scan& scan)
{
  double reach = 0;
  for (std::size_t i = 0; i < scan.size(); ++i)
    reach = std::max(reach, scan.point(i).norm());
  return reach;
}

RigidTransform
toTransform(const Eigen::Isometry3d& T)
{
  return {T.linear(), T.translation()};
}

} // namespace

std::string
beyondNear(double distance, const Near& near, bool would_be_trusted)
{
  return "the pose is " + program::rounded(distance, 2) +
         " away from the place of --near, where " + detail::toText(near.radius) +
         " is allowed" + (would_be_trusted ? ": it is not trusted" : "");
}

Locator::Locator(const Options& options,
                 const std::optional<RigidTransform>& guess,
                 const ScanIndex& map,
                 PairRegistration& registration)
    : options_(options),
      pair_options_(pairOptions(options, guess)),
      map_(map),
      registration_(registration)
{
}

Located
Locator::locate(const program::ScanFile& file)
{
  Scan scan;
  return locate(file, pair_options_, scan);
}

Located
Locator::locate(const program::ScanFile& file,
                const RigidTransform& T_sequence_scan,
                Scan& scan)
{
  PairOptions pair_options = forSequence(pair_options_);
  if (pair_options.guess)
    pair_options.guess =
        toTransform(pair_options.guess->toIsometry() * T_sequence_scan.toIsometry());
  return locate(file, pair_options, scan);
}

Located
Locator::locate(const program::ScanFile& file,
                const PairOptions& pair_options,
                Scan& scan)
{
  const detail::Stopwatch total;
  Located located;
  located.file = file;
  try {
    const ScanSettings settings{
        map_.scan().spacing(), options_.bin_fields, options_.viewpoint_known};
    const InputScan input = readScan(file.path, settings, registration_);
    scan = input.scan;
    located.warnings = input.warnings;
    located.times.reading = input.reading;
    located.times.scan = input.making;
    located.keypoints = input.scan.size();
    place(scan, pair_options, located);
  }
  catch (const io::InputError& error) {
    located.error = error.what();
  }
  catch (const std::invalid_argument& error) {
    located.error = file.path + ": " + error.what();
  }
  located.times.total = total.milliseconds();
  return located;
}

void
Locator::place(const Scan& scan, const PairOptions& pair_options, Located& located)
{
  const detail::Stopwatch watch;
  const ScanIndex& where = options_.near ? partFor(scan) : map_;
  if (where.scan().empty()) {
    located.warnings.push_back("the map has no points near the place of --near");
    return;
  }
  const PairResult pair = registration_.align(scan, where, pair_options);
  located.result = pair.pose;
  located.correspondences = pair.correspondences;
  if (options_.near)
    judgeNear(located);
  const std::string flat = program::flatnessDoubt(scan);
  if (!located.isTrusted() && !flat.empty())
    located.warnings.push_back(flat);
  located.times.placing = watch.milliseconds();
}

/** \brief What the scan can see from where it can be. The radius is rounded up, so that
 * scans of about the same reach share a part. */
const ScanIndex&
Locator::partFor(const Scan& scan)
{
  constexpr double STEP = 1.25;
  const double needed = options_.near->radius + reachOf(scan);
  const double radius = std::pow(STEP, std::ceil(std::log(needed) / std::log(STEP)));
  if (radius != part_radius_) {
    const Scan part = map_.scan().within(options_.near->centre, radius);
    part_ = part.empty() ? ScanIndex() : registration_.makeIndex(part);
    part_radius_ = radius;
  }
  return part_;
}

void
Locator::judgeNear(Located& located) const
{
  const Near& near = *options_.near;
  const double distance = (located.T_map_scan().translation - near.centre).norm();
  if (!located.hasPose() || distance <= near.radius)
    return;
  located.warnings.push_back(beyondNear(distance, near, located.isTrusted()));
  located.result.converged = false;
}

} // namespace pcl_flashreg::localize
