// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/grouping.h"

#include "multiview/bond.h"
#include "multiview/map_refinement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Logarithm of odds that need not wait for what else may turn out. */
constexpr double CERTAIN = 4;
/** \brief Poses are optimized when a group has grown by this share. */
constexpr double GROWN = 0.2;

class Joining {
public:
  Joining(const MapScans& scans,
          const std::vector<PairVotes>& pairs,
          Grouping start,
          double least_odds,
          ThreadPool& pool)
      : scans_(scans),
        map_(std::move(start)),
        least_odds_(least_odds),
        pool_(pool),
        settled_at_(map_.groups.size())
  {
    std::vector<std::size_t> group_of(map_.poses.size());
    for (std::size_t g = 0; g < map_.groups.size(); ++g) {
      settled_at_[g] = map_.groups[g].size();
      for (const std::size_t scan : map_.groups[g])
        group_of[scan] = g;
    }
    for (const PairVotes& pair : pairs) {
      const std::size_t a = group_of[pair.target], b = group_of[pair.source];
      if (a != b)
        bonds_[std::minmax(a, b)].pairs.push_back(&pair);
      else
        within_[a].push_back(&pair);
    }
    std::vector<Bonds::iterator> all;
    for (auto bond = bonds_.begin(); bond != bonds_.end(); ++bond)
      all.push_back(bond);
    countAll(all);
  }

  Grouping
  run()
  {
    for (auto best = surest(); best != bonds_.end(); best = surest()) {
      if (best->second.judged)
        join(best);
      else
        askClouds(best->second, endsOf(best->first));
    }
    Grouping result{{}, std::move(map_.poses)};
    for (std::vector<std::size_t>& group : map_.groups)
      if (!group.empty())
        result.groups.push_back(std::move(group));
    return result;
  }

private:
  using Groups = std::pair<std::size_t, std::size_t>;
  using Bonds = std::map<Groups, Bond>;

  BondEnds
  endsOf(const Groups& groups) const
  {
    return {map_.groups[groups.first], map_.groups[groups.second]};
  }

  void
  countAll(const std::vector<Bonds::iterator>& bonds)
  {
    pool_.forEach(bonds.size(), [&](std::size_t i, std::size_t) {
      count(bonds[i]->second, endsOf(bonds[i]->first), scans_, map_.poses);
    });
  }

  void
  askClouds(Bond& bond, const BondEnds& ends)
  {
    std::vector<Placement>& placements = bond.placements.best;
    pool_.forEach(placements.size(), [&](std::size_t i, std::size_t) {
      judge(placements[i], ends, scans_, map_.poses);
    });
    conclude(bond, ends, scans_, map_.poses);
  }

  /** \brief In which order bonds are looked at, none if never: those that are certain, then
   * those that may turn out to be, before one that just is certain enough. */
  std::optional<double>
  urgencyOf(const Bond& bond) const
  {
    if (bond.prospect < least_odds_)
      return std::nullopt;
    return bond.judged && bond.prospect < CERTAIN ? bond.prospect
                                                  : std::max(bond.urgency, CERTAIN);
  }

  Bonds::iterator
  surest()
  {
    auto best = bonds_.end();
    std::optional<double> highest;
    for (auto bond = bonds_.begin(); bond != bonds_.end(); ++bond)
      if (const auto urgency = urgencyOf(bond->second);
          urgency && (!highest || *urgency > *highest)) {
        best = bond;
        highest = urgency;
      }
    return best;
  }

  void
  join(Bonds::iterator bond)
  {
    const auto [kept, gone] = bond->first;
    const Eigen::Isometry3d T = bond->second.best().T_fixed_moving;
    for (const std::size_t scan : map_.groups[gone]) {
      map_.poses[scan] = T * map_.poses[scan];
      map_.groups[kept].push_back(scan);
    }
    map_.groups[gone].clear();
    std::sort(map_.groups[kept].begin(), map_.groups[kept].end());
    auto& within = within_[kept];
    const auto append = [&](const std::vector<const PairVotes*>& pairs) {
      within.insert(within.end(), pairs.begin(), pairs.end());
    };
    append(bond->second.pairs);
    append(within_[gone]);
    bonds_.erase(bond);
    settle(kept);
    takeOver(kept, gone);
  }

  /** \brief Poses by all pairs within the group that agree with them. */
  void
  settle(std::size_t group)
  {
    const auto size = static_cast<double>(map_.groups[group].size());
    if (size < 3 || size < (1 + GROWN) * static_cast<double>(settled_at_[group]))
      return;
    settled_at_[group] = map_.groups[group].size();
    settlePoses(scans_, within_[group], map_.groups[group], map_.poses, pool_);
  }

  /** \brief The bonds of a group that is gone are those of the one it went to. */
  void
  takeOver(std::size_t kept, std::size_t gone)
  {
    std::map<Groups, std::vector<const PairVotes*>> moved;
    for (auto bond = bonds_.begin(); bond != bonds_.end();) {
      const auto [a, b] = bond->first;
      const bool a_joined = a == gone || a == kept, b_joined = b == gone || b == kept;
      if (!a_joined && !b_joined) {
        ++bond;
        continue;
      }
      auto& pairs = moved[std::minmax(kept, a_joined ? b : a)];
      pairs.insert(pairs.end(), bond->second.pairs.begin(), bond->second.pairs.end());
      bond = bonds_.erase(bond);
    }
    std::vector<Bonds::iterator> all;
    for (auto& [groups, pairs] : moved) {
      all.push_back(bonds_.emplace(groups, Bond()).first);
      all.back()->second.pairs = std::move(pairs);
    }
    countAll(all);
  }

  const MapScans& scans_;
  Grouping map_;
  double least_odds_;
  ThreadPool& pool_;
  std::vector<std::size_t> settled_at_;
  Bonds bonds_;
  std::map<std::size_t, std::vector<const PairVotes*>> within_;
};

std::vector<std::size_t>
without(std::vector<std::size_t> group, std::size_t scan)
{
  group.erase(std::find(group.begin(), group.end(), scan));
  return group;
}

/** \brief Where a scan would be put among others that are all in one frame, and how sure that is:
 * the logarithm of the odds. */
struct Placing {
  Eigen::Isometry3d place;
  double odds;
};

std::optional<Placing>
placeAmong(const std::vector<std::size_t>& others,
           std::size_t scan,
           const std::vector<const PairVotes*>& pairs_of_scan,
           const MapScans& scans,
           const MapPoses& poses)
{
  Bond bond;
  for (const PairVotes* pair : pairs_of_scan) {
    const std::size_t other = pair->target == scan ? pair->source : pair->target;
    if (std::binary_search(others.begin(), others.end(), other))
      bond.pairs.push_back(pair);
  }
  if (bond.pairs.empty())
    return std::nullopt;
  const std::vector<std::size_t> itself{scan};
  const BondEnds ends{others, itself};
  count(bond, ends, scans, poses);
  // What can't become certain need not be judged.
  if (!bond.judged && bond.prospect > 0) {
    for (Placement& placement : bond.placements.best)
      judge(placement, ends, scans, poses);
    conclude(bond, ends, scans, poses);
  }
  return Placing{bond.best().T_fixed_moving * poses[scan], bond.prospect};
}

/** \brief How sure it is that a scan is in the right place of the right group: that all others of
 * the group would put it there, and no other group of several would put it anywhere. */
double
confidenceOf(std::size_t scan,
             const std::vector<std::vector<std::size_t>>& groups,
             const std::vector<const PairVotes*>& pairs_of_scan,
             const MapScans& scans,
             const MapPoses& poses)
{
  double here = 0, elsewhere = 0, nowhere = 1;
  for (const std::vector<std::size_t>& group : groups) {
    if (group.size() < 2)
      continue;
    const bool own = std::binary_search(group.begin(), group.end(), scan);
    const auto placing =
        own ? placeAmong(without(group, scan), scan, pairs_of_scan, scans, poses)
            : placeAmong(group, scan, pairs_of_scan, scans, poses);
    if (!placing)
      continue;
    const double probability = 1 / (1 + std::exp(-placing->odds));
    const bool stays =
        own && samePlace(placing->place, poses[scan], scans[scan].spacing);
    here = here * (1 - probability) + (stays ? nowhere * probability : 0);
    elsewhere = elsewhere * (1 - probability) + (stays ? 0 : nowhere * probability);
    nowhere *= 1 - probability;
  }
  return here / (here + elsewhere + nowhere);
}

/** \brief Parts of a group that pairs tie together whose most probable pose is the map's. */
std::vector<std::vector<std::size_t>>
tiedParts(const std::vector<std::size_t>& group,
          const std::vector<PairVotes>& pairs,
          const MapScans& scans,
          const MapPoses& poses)
{
  std::map<std::size_t, std::size_t> part_of;
  for (const std::size_t scan : group)
    part_of[scan] = scan;
  const auto rootOf = [&](std::size_t scan) {
    while (part_of[scan] != scan)
      scan = part_of[scan];
    return scan;
  };
  for (const PairVotes& pair : pairs)
    if (part_of.count(pair.target) > 0 && part_of.count(pair.source) > 0 &&
        samePlace(poses[pair.target] * pair.votes.front().T_target_source,
                  poses[pair.source],
                  scans[pair.source].spacing)) {
      const std::size_t a = rootOf(pair.target), b = rootOf(pair.source);
      part_of[std::max(a, b)] = std::min(a, b);
    }
  std::map<std::size_t, std::vector<std::size_t>> parts;
  for (const std::size_t scan : group)
    parts[rootOf(scan)].push_back(scan);
  std::vector<std::vector<std::size_t>> result;
  for (auto& [root, part] : parts)
    result.push_back(std::move(part));
  return result;
}

} // namespace

Grouping
joinGroups(const MapScans& scans,
           const std::vector<PairVotes>& pairs,
           Grouping start,
           double min_confidence,
           ThreadPool& pool)
{
  const double least_odds = std::log(min_confidence / (1 - min_confidence));
  return Joining(scans, pairs, std::move(start), least_odds, pool).run();
}

std::vector<double>
confidencesOf(const MapScans& scans,
              const std::vector<PairVotes>& pairs,
              const Grouping& map,
              ThreadPool& pool)
{
  std::vector<std::vector<const PairVotes*>> pairs_of(map.poses.size());
  for (const PairVotes& pair : pairs) {
    pairs_of[pair.target].push_back(&pair);
    pairs_of[pair.source].push_back(&pair);
  }
  std::vector<char> alone(map.poses.size());
  for (const std::vector<std::size_t>& group : map.groups)
    if (group.size() == 1)
      alone[group.front()] = 1;
  std::vector<double> confidences(map.poses.size());
  pool.forEach(confidences.size(), [&](std::size_t scan, std::size_t) {
    if (alone[scan] == 0)
      confidences[scan] =
          confidenceOf(scan, map.groups, pairs_of[scan], scans, map.poses);
  });
  return confidences;
}

void
releaseDoubtful(const MapScans& scans,
                const std::vector<PairVotes>& pairs,
                const std::vector<double>& confidences,
                double least_confidence,
                Grouping& map)
{
  std::vector<std::vector<std::size_t>> groups;
  for (const std::vector<std::size_t>& group : map.groups) {
    std::vector<std::size_t> kept;
    for (const std::size_t scan : group)
      if (group.size() == 1 || confidences[scan] >= least_confidence)
        kept.push_back(scan);
      else
        groups.push_back({scan});
    for (std::vector<std::size_t>& part : tiedParts(kept, pairs, scans, map.poses))
      groups.push_back(std::move(part));
  }
  std::sort(groups.begin(), groups.end());
  map.groups = std::move(groups);
}

} // namespace pcl_flashreg
