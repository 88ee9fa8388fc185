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
 * MultiviewOptions::alike are looked for, for scans of a group and for those that are alone. */
constexpr std::size_t REPEATED = 2, REPEATED_ALONE = 4;

/** \brief The probability of a pair's best pose that is worth a second try. */
constexpr double PROMISING = 0.05;

ScanPairs
listed(const std::set<MultiviewRegistration::ScanPair>& pairs)
{
  return {pairs.begin(), pairs.end()};
}

} // namespace

ScanPairs
firstPairs(const Likeness& likeness, std::size_t count, const MultiviewOptions& options)
{
  std::set<MultiviewRegistration::ScanPair> pairs;
  for (std::size_t scan = 0; scan < count; ++scan) {
    std::vector<std::size_t> others = likeness.ranked(scan);
    others.resize(std::min(others.size(), options.alike));
    for (const std::size_t other : others)
      pairs.insert(std::minmax(scan, other));
    for (std::size_t next = scan + 1;
         options.sequence && next < std::min(count, scan + 1 + NEIGHBOURS);
         ++next)
      pairs.insert({scan, next});
  }
  return listed(pairs);
}

ScanPairs
untiedPairs(const Likeness& likeness,
            const std::vector<ScanRelation>& tried,
            const MultiviewResult& map,
            const MultiviewOptions& options)
{
  const auto tied = [&](const MultiviewRegistration::ScanPair& pair) {
    return map.scans[pair.first].group == map.scans[pair.second].group;
  };
  const std::size_t count = map.scans.size();
  std::set<MultiviewRegistration::ScanPair> known, pairs;
  std::vector<std::size_t> tries(count);
  for (const ScanRelation& relation : tried) {
    known.insert({relation.target, relation.source});
    ++tries[relation.target];
    ++tries[relation.source];
  }
  const bool few = count <= options.all_pairs_up_to;
  for (std::size_t scan = 0; scan < count; ++scan) {
    std::size_t left = few ? count : options.alike;
    const bool alone = map.groups[map.scans[scan].group].size() == 1;
    if (!few && tries[scan] >= (alone ? REPEATED_ALONE : REPEATED) * options.alike)
      continue;
    for (const std::size_t other : likeness.ranked(scan)) {
      const MultiviewRegistration::ScanPair pair = std::minmax(scan, other);
      if (left == 0)
        break;
      if (tied(pair) || known.count(pair) > 0)
        continue;
      pairs.insert(pair);
      --left;
    }
  }
  if (!pairs.empty())
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
