// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/bond.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief Ways for two groups to lie to each other that the clouds are asked about. */
constexpr std::size_t PLACEMENTS = 10;

/** \brief Weights of the votes and of the harmony of the clouds in the logarithm of a
 * placement's likelihood, and that of there being none: a conditional logistic regression. */
constexpr double BY_VOTES = 0.5, BY_HARMONY = 1.52, NONE = 6.83;

/** \brief By how much votes can speak against none: pairs that see the same place err
 * together, however many they are. */
constexpr double MOST_AGAINST_NONE = 12;

/** \brief The logarithm of a sum of exponentials. */
double
logSum(double a, double b)
{
  const double high = std::max(a, b), low = std::min(a, b);
  return high + std::log1p(std::exp(low - high));
}

double
weightOf(const Placement& placement)
{
  return BY_VOTES * placement.votes + BY_HARMONY * placement.harmony;
}

/** \brief The logarithm of the odds of the first placement against all others and none. */
double
oddsOf(const Placements& placements)
{
  const Placement& best = placements.best.front();
  double others =
      NONE + BY_VOTES * std::max(placements.none, best.votes - MOST_AGAINST_NONE);
  for (std::size_t i = 1; i < placements.best.size(); ++i)
    others = logSum(others, weightOf(placements.best[i]));
  return weightOf(best) - others;
}

/** \brief The same by the votes alone, as if pairs erred by themselves. */
double
oddsOfVotes(const Placements& placements)
{
  double others = placements.none;
  for (std::size_t i = 1; i < placements.best.size(); ++i)
    others = logSum(others, placements.best[i].votes);
  return placements.best.front().votes - others;
}

} // namespace

void
count(Bond& bond, const BondEnds& ends, const MapScans& scans, const MapPoses& poses)
{
  std::vector<bool> is_moving(poses.size());
  for (const std::size_t scan : ends.moving)
    is_moving[scan] = true;
  const double spacing = scans[ends.moving.front()].spacing;
  Placements& placements = bond.placements;
  placements = countVotes(bond.pairs, is_moving, poses, spacing, PLACEMENTS);
  for (Placement& placement : placements.best)
    placement.harmony = HARMONY;
  bond.urgency = oddsOfVotes(placements);
  // A pair has asked its clouds already.
  bond.judged = ends.fixed.size() == 1 && ends.moving.size() == 1;
  bond.prospect =
      bond.judged ? bond.urgency : oddsOf({{placements.best.front()}, placements.none});
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
  placement.harmony = judgement.agreement(meetings, placement.T_fixed_moving).harmony();
}

void
conclude(Bond& bond, const BondEnds& ends, const MapScans& scans, const MapPoses& poses)
{
  std::vector<Placement> judged = std::move(bond.placements.best);
  std::stable_sort(judged.begin(), judged.end(), [](const auto& a, const auto& b) {
    return weightOf(a) > weightOf(b);
  });
  // On the surfaces some turn out to be the same.
  const std::size_t some = ends.moving.front();
  const double spacing = scans[some].spacing;
  std::vector<Placement>& best = bond.placements.best;
  best.clear();
  for (const Placement& placement : judged)
    if (std::none_of(best.begin(), best.end(), [&](const Placement& other) {
          return samePlace(placement.T_fixed_moving * poses[some],
                           other.T_fixed_moving * poses[some],
                           spacing);
        }))
      best.push_back(placement);
  bond.prospect = oddsOf(bond.placements);
  bond.judged = true;
}

} // namespace pcl_flashreg
