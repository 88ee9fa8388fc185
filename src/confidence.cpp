// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "confidence.h"

#include <cmath>

namespace pcl_flashreg {
namespace {

double
logistic(double x)
{
  return 1 / (1 + std::exp(-x));
}

double
fromCorrespondences(const Evidence& e)
{
  return logistic(-11.71 + 3.24 * std::log(e.inliers + 1) +
                  1.87 * std::log(e.inlier_ratio + 1e-4) +
                  0.34 * std::log((e.inliers + 1) / (e.rival_inliers + 3)) +
                  1.62 * std::log(e.thickness + 1));
}

double
fromClouds(const Evidence& e)
{
  return logistic(-22.08 + 0.68 * std::log(e.agreement.matched + 0.01) -
                  4.49 * std::log(e.agreement.contradicted + 0.01) +
                  2.00 * std::log(e.inliers + 5) + 0.96 * e.lead +
                  1.17 * std::log(e.stiffness + 0.001));
}

double
fromCloudsWithoutViewpoints(const Evidence& e)
{
  return logistic(-2.0 + 0.68 * std::log(e.agreement.matched + 0.01) +
                  2.00 * std::log(e.inliers + 5) + 0.96 * e.lead +
                  1.17 * std::log(e.stiffness + 0.001));
}

} // namespace

double
confidenceOf(const Evidence& evidence)
{
  if (!evidence.has_clouds)
    return fromCorrespondences(evidence);
  return evidence.has_viewpoints ? fromClouds(evidence)
                                 : fromCloudsWithoutViewpoints(evidence);
}

} // namespace pcl_flashreg
