// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/tilt.h"

#include "judgement/cpu/plane_alignment.h"
#include "judgement/evidence.h"
#include "judgement/explained.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief From here on gravity has turned a pose back, and from there on it forbids one that
 * is not just inexact, in degrees. */
constexpr double TURNED_BACK = -0.1, FORBIDDEN = 5;
/** \brief See refined(); and how often a pose is moved onto the surface, which takes it a few
 * degrees at a time. */
constexpr int ROUNDS = 20, MOVES = 3;

/** \brief Of a rival that explains less, or more, as a logarithm. */
constexpr double STEEPNESS = 4;

/** \brief See Look. */
constexpr std::size_t POINTS = 1000;
constexpr float TOLERANCE = 1.5f, MARGIN = 2;

double
logOfInliers(const Problem& problem, const Pose& pose, float inlier_distance)
{
  return std::log(
      static_cast<double>(inliersOf(problem, pose, inlier_distance).size()) + 5.0);
}

} // namespace

bool
tiltsBeyond(const Upright& upright, const Pose& pose, double degrees)
{
  if (!upright.required)
    return false;
  const double angle = degrees * 3.14159265358979323846 / 180;
  return dot(rotate(pose.r, upright.source_up), upright.target_up) <
         upright.cosine * std::cos(angle) - upright.sine * std::sin(angle);
}

double
tiltedEvidence(const Problem& problem,
               const SurfacePair* clouds,
               const Pose& pose,
               float inlier_distance)
{
  if (!tiltsBeyond(problem.upright, pose, TURNED_BACK))
    return 0;
  // What speaks for a pose, as a logarithm.
  const auto weightOf = [&](const Pose& of) {
    const double inliers = logOfInliers(problem, of, inlier_distance);
    return clouds ? evidenceOf(Look(*clouds, POINTS, TOLERANCE, MARGIN)(of)) +
                        0.5 * inliers
                  : inliers;
  };
  std::vector<Pose> released{
      refined(problem, pose, Isometries{}, ROUNDS, inlier_distance).pose};
  if (clouds) {
    SurfacePair free = *clouds;
    free.upright = {};
    released.front() = moveOntoTarget(free, released.front());
    released.push_back(pose);
    for (int move = 0; move < MOVES; ++move)
      released.back() = moveOntoTarget(free, released.back());
  }
  const double weight = weightOf(pose);
  double tilted = 0;
  for (const Pose& other : released)
    if (tiltsBeyond(problem.upright, other, FORBIDDEN))
      tilted = std::max(tilted, std::exp(STEEPNESS * (weightOf(other) - weight)));
  return tilted;
}

} // namespace pcl_flashreg
