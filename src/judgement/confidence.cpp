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

/** \brief No pose is more certain than its lead over its rival lets it be: 50 % for one
 * with as many inliers. */
double
limitByRival(const Evidence& e)
{
  return 1 / (1 + std::pow(e.rival_inliers / std::max(1.0, e.inliers), 4));
}

/** \brief Nor than that it is no play of chance: 50 % where one pose is expected to have as
 * many inliers with pairs that were drawn at random. */
double
limitByChance(const Evidence& e)
{
  return logistic(-e.log_chance);
}

/** \brief Nor than that the inliers hold it: on a line as thin as the inlier distance, it may
 * turn. */
double
limitByBreadth(const Evidence& e)
{
  const double fourth = std::pow(e.breadth, 4);
  return fourth / (1 + fourth);
}

double
fromCorrespondences(const Evidence& e)
{
  const double p = logistic(-11.56 + 3.23 * std::log(e.inliers + 1) +
                            1.90 * std::log(e.inlier_ratio + 1e-4) +
                            0.33 * std::log((e.inliers + 1) / (e.rival_inliers + 3)) +
                            1.66 * std::log(e.thickness + 1));
  return std::min({p, limitByRival(e), limitByChance(e), limitByBreadth(e)});
}

/** \brief Where a reflection explains more than any motion, no motion is right. */
double
limitByMirror(const Evidence& e)
{
  return logistic(3 * (1.2 - e.mirrored));
}

/** \brief A pose that the surfaces leave free to move in some direction is not certain,
 * whatever else speaks for it. */
double
limitByStiffness(const Evidence& e)
{
  const double sixth = std::pow(e.stiffness / 0.0005, 6);
  return sixth / (1 + sixth);
}

double
fromClouds(const Evidence& e)
{
  return logistic(-23.64 + 0.90 * std::log(e.agreement.matched + 0.01) -
                  4.73 * std::log(e.agreement.contradicted + 0.01) +
                  2.47 * std::log(e.inliers + 5) + 1.08 * e.lead +
                  1.32 * std::log(e.stiffness + 0.001));
}

double
fromCloudsWithOneViewpoint(const Evidence& e)
{
  return logistic(-11.58 - 0.77 * std::log(e.agreement.matched + 0.01) -
                  1.87 * std::log(e.agreement.contradicted + 0.01) +
                  2.67 * std::log(e.inliers + 5) + 2.17 * e.lead +
                  2.12 * std::log(e.stiffness + 0.001));
}

double
fromCloudsWithoutViewpoints(const Evidence& e)
{
  return logistic(-10.48 - 0.74 * std::log(e.agreement.matched + 0.01) +
                  3.89 * std::log(e.inliers + 5) + 0.38 * e.lead +
                  1.92 * std::log(e.stiffness + 0.001));
}

double
fittedToClouds(const Evidence& e)
{
  if (!e.has_viewpoints)
    return fromCloudsWithoutViewpoints(e);
  return e.one_viewpoint ? fromCloudsWithOneViewpoint(e) : fromClouds(e);
}

} // namespace

double
confidenceOfClouds(const Evidence& evidence)
{
  return std::min(fittedToClouds(evidence), limitByStiffness(evidence));
}

double
confidenceOf(const Evidence& evidence)
{
  return std::min(evidence.has_clouds ? confidenceOfClouds(evidence)
                                      : fromCorrespondences(evidence),
                  limitByMirror(evidence));
}

} // namespace pcl_flashreg
