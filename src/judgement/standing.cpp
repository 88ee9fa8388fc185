// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/standing.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief How fast a rival falls silent as all that speaks for the pose leads. */
constexpr double BY_ALL = 4;

} // namespace

double
weightOf(const Standing& pose)
{
  return evidenceOf(pose.agreement) + 0.5 * std::log(pose.support + 5.0);
}

double
leadOf(const Standing& best, const Standing* next)
{
  constexpr double MOST = 5;
  return next ? std::min(MOST, weightOf(best) - weightOf(*next)) : MOST;
}

double
leadByClouds(const Standing& pose, const Standing& other)
{
  return evidenceOf(pose.agreement) - evidenceOf(other.agreement);
}

double
loudnessOf(const Standing& rival, const Standing& pose)
{
  const double lead = weightOf(pose) - weightOf(rival);
  return std::max(std::exp(-BY_ALL * std::max(0.0, lead)),
                  loudnessByClouds(rival.support, leadByClouds(pose, rival)));
}

double
loudnessInMap(double lead, double lead_by_clouds)
{
  constexpr double BY_CLOUDS = 8;
  return std::max(std::exp(-BY_ALL * std::max(0.0, lead)),
                  std::exp(-BY_CLOUDS * std::max(0.0, lead_by_clouds - ALIKE_IN_MAP)));
}

double
loudnessByClouds(double support, double lead)
{
  constexpr double MOST = 8, LEAST = 3, A_FEW_DOZEN = 60;
  const double dozens = support / A_FEW_DOZEN;
  const double steepness = std::clamp(MOST / std::max(dozens, 1e-3), LEAST, MOST);
  const double supported = 1 - 1 / (1 + std::pow(dozens, 4));
  return supported * std::exp(-steepness * std::max(0.0, lead));
}

} // namespace pcl_flashreg
