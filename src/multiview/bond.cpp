// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/bond.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

/** \brief Ways for two groups to lie to each other that the clouds are asked about. */
constexpr std::size_t PLACEMENTS = 10;

/** \brief Logarithm of the odds that votes alone can give: pairs that see the same place err
 * together, however many they are. */
constexpr double MOST_BY_VOTES = 7;

/** \brief The logarithm of a sum of exponentials. */
double
logSum(double a, double b)
{
  const double high = std::max(a, b), low = std::min(a, b);
  return high + std::log1p(std::exp(low - high));
}

/** \brief Of the first placement against all others and none. */
double
oddsOf(const Placements& placements)
{
  if (placements.best.empty())
    return -std::numeric_limits<double>::infinity();
  double others = placements.none;
  for (std::size_t i = 1; i < placements.best.size(); ++i)
    others = logSum(others, placements.best[i].weight);
  return placements.best.front().weight - others;
}

} // namespace

void
count(Bond& bond, const BondEnds& ends, const MapScans& scans, const MapPoses& poses)
{
  std::vector<bool> is_moving(poses.size());
  for (const std::size_t scan : ends.moving)
    is_moving[scan] = true;
  const double spacing = scans(ends.moving.front())->spacing;
  Placements& placements = bond.placements;
  placements = countVotes(bond.pairs, is_moving, poses, spacing, PLACEMENTS);
  bond.urgency = oddsOf(placements);
  if (!placements.best.empty())
    placements.none =
        std::max(placements.none, placements.best.front().weight - MOST_BY_VOTES);
  bond.prospect = oddsOf(placements);
  bond.judged = false;
}

void
judge(Placement& placement,
      const BondEnds& ends,
      const MapScans& scans,
      const MapPoses& poses)
{
  const JointJudgement judgement(scans, poses);
  const auto meetings =
      judgement.meetings(ends.fixed, ends.moving, placement.T_fixed_moving);
  placement.T_fixed_moving =
      judgement.moveOntoFixed(meetings, placement.T_fixed_moving);
  placement.weight += judgement.agreement(meetings, placement.T_fixed_moving).logOdds();
}

void
conclude(Bond& bond)
{
  std::vector<Placement>& best = bond.placements.best;
  std::stable_sort(best.begin(), best.end(), [](const auto& a, const auto& b) {
    return a.weight > b.weight;
  });
  bond.prospect = oddsOf(bond.placements);
  bond.judged = true;
}

} // namespace pcl_flashreg
