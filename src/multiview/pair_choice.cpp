// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/pair_choice.h"

#include <algorithm>
#include <set>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Scans after each one of a sequence that it is tried with. */
constexpr std::size_t NEIGHBOURS = 3;

/** \brief Of more scans than can all be tried with each other: that often as many as
 * MultiviewOptions::alike in all, for scans of a group and for those that are alone. */
constexpr std::size_t REPEATED = 2, REPEATED_ALONE = 4;

/** \brief Rounds after the first, of more scans than can all be tried: each one's grouping takes
 * as long as thousands of pairs, and those after it would have a few dozen. */
constexpr int ROUNDS_OF_MANY = 2;

/** \brief The probability of a pair's best pose that is worth a second try. */
constexpr double PROMISING = 0.05;

PairChoice::ScanPairs
listed(const std::set<MultiviewRegistration::ScanPair>& pairs)
{
  return {pairs.begin(), pairs.end()};
}

} // namespace

PairChoice::PairChoice(std::size_t count,
                       const MultiviewRegistration::ScanSource& scans,
                       const MultiviewOptions& options,
                       ThreadPool& pool)
    : count_(count), options_(options), likeness_(count, scans, pool)
{
}

PairChoice::ScanPairs
PairChoice::first() const
{
  std::set<MultiviewRegistration::ScanPair> pairs;
  for (std::size_t scan = 0; scan < count_; ++scan) {
    std::vector<std::size_t> others = likeness_.ranked(scan);
    others.resize(std::min(others.size(), options_.alike));
    for (const std::size_t other : others)
      pairs.insert(std::minmax(scan, other));
    for (std::size_t next = scan + 1;
         options_.sequence && next < std::min(count_, scan + 1 + NEIGHBOURS);
         ++next)
      pairs.insert({scan, next});
  }
  return listed(pairs);
}

PairChoice::ScanPairs
PairChoice::next(const std::vector<ScanRelation>& tried, const Groups& groups)
{
  ++rounds_;
  const bool few = count_ <= options_.all_pairs_up_to;
  if (!few && rounds_ > ROUNDS_OF_MANY)
    return {};
  std::vector<std::size_t> group_of(count_);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const std::size_t scan : groups[g])
      group_of[scan] = g;
  const auto tied = [&](const MultiviewRegistration::ScanPair& pair) {
    return group_of[pair.first] == group_of[pair.second];
  };
  std::set<MultiviewRegistration::ScanPair> known, pairs;
  std::vector<std::size_t> tries(count_);
  for (const ScanRelation& relation : tried) {
    known.insert({relation.target, relation.source});
    ++tries[relation.target];
    ++tries[relation.source];
  }
  for (std::size_t scan = 0; scan < count_; ++scan) {
    const bool alone = groups[group_of[scan]].size() == 1;
    const std::size_t most = (alone ? REPEATED_ALONE : REPEATED) * options_.alike;
    // Other scans may have asked for more pairs than that.
    std::size_t left = few ? count_ : most - std::min(most, tries[scan]);
    for (const std::size_t other : likeness_.ranked(scan)) {
      const MultiviewRegistration::ScanPair pair = std::minmax(scan, other);
      if (left == 0)
        break;
      if (tied(pair) || known.count(pair) > 0)
        continue;
      pairs.insert(pair);
      --left;
    }
  }
  const bool last = !few && rounds_ == ROUNDS_OF_MANY;
  if (!pairs.empty() && !last)
    return listed(pairs);
  for (const ScanRelation& relation : tried) {
    const MultiviewRegistration::ScanPair other_way(relation.source, relation.target);
    if (!tied(other_way) && known.count(other_way) == 0 && !relation.poses.empty() &&
        relation.poses.front().probability >= PROMISING)
      pairs.insert(other_way);
  }
  return listed(pairs);
}

} // namespace pcl_flashreg
