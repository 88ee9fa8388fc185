// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/confidence.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

double
logistic(double x)
{
  return 1 / (1 + std::exp(-x));
}

/** \brief Even where the value just is what it has to be. */
double
halfAt(double value, double half, double power)
{
  return 1 - 1 / (1 + std::pow(value / half, power));
}

/** \brief What every pose needs that correspondences speak for: an even chance for each that
 * it just lacks. */
double
neededOfCorrespondences(const Evidence& e)
{
  // A lead over its rival.
  const double alone =
      1 / (1 + std::pow(e.rival_inliers / std::max(1.0, e.inliers), 4));
  // More of them than one pose is expected to have with pairs that were drawn at random.
  const double no_chance = logistic(-e.log_chance);
  // Inliers that hold it: on a line as thin as the inlier distance, it may turn.
  const double held = halfAt(e.breadth, 1, 4);
  return alone * no_chance * held;
}

double
fromCorrespondences(const Evidence& e)
{
  return logistic(-11.23 + 2.65 * std::log(e.inliers + 1) +
                  1.52 * std::log(e.inlier_ratio + 1e-4) +
                  2.88 * std::log((e.inliers + 1) / (e.rival_inliers + 3)) +
                  2.90 * std::log(e.thickness + 1));
}

/** \brief Where a reflection explains more than any motion, no motion is right. */
double
notMirrored(const Evidence& e)
{
  return logistic(3 * (1.2 - e.mirrored));
}

/** \brief Where a pose that gravity forbids explains as much, gravity may be wrong. */
double
notTilted(const Evidence& e)
{
  return 1 / (1 + std::pow(e.tilted, 1.5));
}

/** \brief What every pose needs that clouds are to confirm, whatever else speaks for it: an
 * even chance for each that it just lacks. */
double
neededOfClouds(const Evidence& e)
{
  // No others that explain as much: at most one over their number, and its own.
  const double alone = 1 / (1 + std::pow(e.rivals, 1.5));
  // No way to move it and still explain as much.
  const double held = logistic(8 * (e.hold - 0.2));
  // Nor one that the surfaces don't oppose.
  const double stiff = halfAt(e.stiffness, NEEDED_STIFFNESS, 4);
  return alone * held * stiff;
}

double
holdOf(const Evidence& e)
{
  return std::clamp(e.hold, -1.0, 2.0);
}

/** \brief Of a regression on what the clouds say; 0 for what it does not ask. */
struct CloudWeights {
  double constant, matched, contradicted, inliers, lead, stiffness, hold, residual;
};

constexpr CloudWeights BOTH_VIEWPOINTS{
    -5.55, 1.69, -1.69, 0.93, 0.65, 0.56, 1.76, -3.39};
constexpr CloudWeights ONE_VIEWPOINT_AND_SIDES{
    -4.53, 1.20, -1.03, 2.14, 0.48, 1.15, 0.17, -3.52};
constexpr CloudWeights ONE_VIEWPOINT{-3.54, 0, 0, 1.96, 1.19, 0.97, 2.03, -5.66};
constexpr CloudWeights SIDES{-2.48, 1.43, -0.86, 2.48, 0, 1.33, 0, -4.51};
constexpr CloudWeights NOTHING{-6.65, 0, 0, 2.57, 2.08, 0.76, 1.55, -5.23};

constexpr CloudWeights IN_MAP{-11.30, 1.06, -1.73, 1.29, 2.11, 0, 0, 0};

const CloudWeights&
weightsFor(const Evidence& e)
{
  if (e.in_map)
    return IN_MAP;
  if (!e.has_viewpoints)
    return e.has_sides ? SIDES : NOTHING;
  if (!e.one_viewpoint)
    return BOTH_VIEWPOINTS;
  return e.has_sides ? ONE_VIEWPOINT_AND_SIDES : ONE_VIEWPOINT;
}

double
fromClouds(const Evidence& e)
{
  const CloudWeights& w = weightsFor(e);
  const double matched = e.agreement.matched + 0.01;
  return logistic(w.constant + w.matched * std::log(matched) +
                  w.contradicted * std::log(e.agreement.contradicted / matched + 0.01) +
                  w.inliers * std::log(e.inliers + 5) + w.lead * e.lead +
                  w.stiffness * std::log(e.stiffness + 0.001) + w.hold * holdOf(e) +
                  w.residual * e.agreement.residual);
}

/** \brief A probability whose odds are divided by this. */
double
lessLikely(double probability, double odds)
{
  return probability / (probability + odds * (1 - probability));
}

} // namespace

double
confidenceOfClouds(const Evidence& evidence)
{
  const double p = fromClouds(evidence) * neededOfClouds(evidence);
  // Viewpoints are right more often than not, and so are normals.
  constexpr double ODDS = 3;
  const double with_doubt = evidence.overruled_viewpoints || evidence.overruled_sides
                                ? lessLikely(p, ODDS)
                                : p;
  // The more poses are tried, the better the best of the wrong ones.
  constexpr double ODDS_OF_SECOND_LOOK = 2;
  return evidence.second_look ? lessLikely(with_doubt, ODDS_OF_SECOND_LOOK)
                              : with_doubt;
}

double
confidenceOf(const Evidence& evidence)
{
  const double p = evidence.has_clouds ? confidenceOfClouds(evidence)
                                       : fromCorrespondences(evidence) *
                                             neededOfCorrespondences(evidence);
  return p * notMirrored(evidence) * notTilted(evidence);
}

} // namespace pcl_flashreg
