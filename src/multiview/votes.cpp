// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/votes.h"

#include "multiview/mean_motion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief The density of agreement by chance (rho), and by how much another supporter counts
 * than the strongest. */
constexpr double BY_CHANCE = 0.02, ANOTHER = 0.25;

/** \brief Votes less than the best's that no cloud makes good. */
constexpr double WITHOUT_A_CHANCE = 20;

/** \brief Poses of pairs that are tried as placements of their groups. */
constexpr std::size_t TRIED = 24;

/** \brief A vote, between the groups. */
struct GroupVote {
  double probability;
  Eigen::Isometry3d T_fixed_moving;
  /** \brief Where it puts the moving scan. */
  Eigen::Isometry3d place;
};

struct GroupVotes {
  std::size_t moving;
  double unsure;
  std::vector<GroupVote> votes;
};

GroupVotes
betweenGroups(const PairVotes& pair,
              const std::vector<bool>& is_moving,
              const MapPoses& poses)
{
  const bool source_moves = is_moving[pair.source];
  GroupVotes result{source_moves ? pair.source : pair.target, pair.unsure(), {}};
  const std::size_t fixed = source_moves ? pair.target : pair.source;
  const Eigen::Isometry3d back = poses[result.moving].inverse(Eigen::Isometry);
  for (const Vote& vote : pair.votes) {
    const Eigen::Isometry3d place =
        poses[fixed] * (source_moves ? vote.T_target_source
                                     : vote.T_target_source.inverse(Eigen::Isometry));
    result.votes.push_back({vote.probability, place * back, place});
  }
  return result;
}

/** \brief The pose of the moving group that fits best to where its supporters put its scans,
 * each by its probability. */
Eigen::Isometry3d
meanOf(const Eigen::Isometry3d& T_fixed_moving,
       const std::vector<GroupVotes>& pairs,
       const MapPoses& poses,
       double spacing)
{
  MeanMotion mean;
  for (const GroupVotes& pair : pairs)
    for (const GroupVote& vote : pair.votes)
      if (samePlace(vote.place, T_fixed_moving * poses[pair.moving], spacing))
        mean.add(vote.probability,
                 vote.T_fixed_moving.linear(),
                 poses[pair.moving].translation(),
                 vote.place.translation());
  return mean.weight() > 0 ? mean.get() : T_fixed_moving;
}

Placement
weigh(const Eigen::Isometry3d& T_fixed_moving,
      const std::vector<GroupVotes>& pairs,
      const MapPoses& poses,
      double spacing)
{
  Placement placement;
  placement.T_fixed_moving = T_fixed_moving;
  placement.votes = std::log(BY_CHANCE);
  double strongest = 0, all = 0;
  for (const GroupVotes& pair : pairs) {
    const Eigen::Isometry3d place = T_fixed_moving * poses[pair.moving];
    double agreeing = 0;
    for (const GroupVote& vote : pair.votes)
      if (samePlace(vote.place, place, spacing))
        agreeing += vote.probability;
    const double gain = std::log(agreeing / BY_CHANCE + pair.unsure);
    if (gain <= 0) {
      placement.votes += gain;
      continue;
    }
    ++placement.supporters;
    strongest = std::max(strongest, gain);
    all += gain;
  }
  placement.votes += ANOTHER * all + (1 - ANOTHER) * strongest;
  return placement;
}

/** \brief The poses that a pair was found to have, as those of the pair with the smaller number
 * as target. */
std::vector<Vote>
votesOf(const ScanRelation& relation, const std::vector<MapScan>& scans)
{
  std::vector<Vote> votes;
  const MapScan &target = scans[relation.target], &source = scans[relation.source];
  for (const RelativePose& pose : relation.poses) {
    const Eigen::Isometry3d T = betweenMiddles(pose.T_target_source, target, source);
    votes.push_back(
        {pose.probability,
         relation.target < relation.source ? T : T.inverse(Eigen::Isometry)});
  }
  return votes;
}

/** \brief Both ways of a pair: what both say is a vote of both. */
std::vector<Vote>
bothWays(std::vector<Vote> votes, const std::vector<Vote>& others, double spacing)
{
  for (Vote& vote : votes)
    vote.probability /= 2;
  const std::size_t first = votes.size();
  for (const Vote& other : others) {
    const auto end = votes.begin() + static_cast<std::ptrdiff_t>(first);
    const auto same = std::find_if(votes.begin(), end, [&](const Vote& vote) {
      return samePlace(vote.T_target_source, other.T_target_source, spacing);
    });
    if (same == end)
      votes.push_back({other.probability / 2, other.T_target_source});
    else
      same->probability += other.probability / 2;
  }
  std::stable_sort(votes.begin(), votes.end(), [](const Vote& a, const Vote& b) {
    return a.probability > b.probability;
  });
  return votes;
}

} // namespace

std::vector<PairVotes>
votesOf(const std::vector<ScanRelation>& relations, const std::vector<MapScan>& scans)
{
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Vote>> forth, back;
  for (const ScanRelation& relation : relations)
    (relation.target < relation.source
         ? forth
         : back)[std::minmax(relation.target, relation.source)] =
        votesOf(relation, scans);
  for (auto& [pair, votes] : back) {
    const auto other = forth.find(pair);
    if (other == forth.end())
      forth.emplace(pair, std::move(votes));
    else
      other->second =
          bothWays(std::move(other->second), votes, scans[pair.second].spacing);
  }
  std::vector<PairVotes> result;
  for (auto& [pair, votes] : forth)
    if (!votes.empty())
      result.push_back({pair.first, pair.second, std::move(votes)});
  return result;
}

double
PairVotes::unsure() const
{
  double sure = 0;
  for (const Vote& vote : votes)
    sure += vote.probability;
  return std::max(1 - sure, 5e-4);
}

Placements
countVotes(const std::vector<const PairVotes*>& pairs,
           const std::vector<bool>& is_moving,
           const MapPoses& poses,
           double spacing,
           std::size_t most)
{
  Placements result;
  std::vector<GroupVotes> between;
  std::vector<const GroupVote*> tried;
  for (const PairVotes* pair : pairs)
    between.push_back(betweenGroups(*pair, is_moving, poses));
  for (const GroupVotes& pair : between) {
    result.none += std::log(pair.unsure);
    for (const GroupVote& vote : pair.votes)
      tried.push_back(&vote);
  }
  std::stable_sort(tried.begin(), tried.end(), [](const auto* a, const auto* b) {
    return a->probability > b->probability;
  });
  tried.resize(std::min(tried.size(), TRIED));
  std::vector<Placement> placements;
  for (const GroupVote* vote : tried)
    placements.push_back(weigh(vote->T_fixed_moving, between, poses, spacing));
  std::stable_sort(placements.begin(),
                   placements.end(),
                   [](const auto& a, const auto& b) { return a.votes > b.votes; });
  const Eigen::Isometry3d& some = poses[between.front().moving];
  for (const Placement& placement : placements)
    if (result.best.size() < most &&
        placement.votes > placements.front().votes - WITHOUT_A_CHANCE &&
        std::none_of(
            result.best.begin(), result.best.end(), [&](const Placement& other) {
              return samePlace(placement.T_fixed_moving * some,
                               other.T_fixed_moving * some,
                               spacing);
            }))
      result.best.push_back(placement);
  for (Placement& placement : result.best)
    placement.T_fixed_moving =
        meanOf(placement.T_fixed_moving, between, poses, spacing);
  return result;
}

} // namespace pcl_flashreg
