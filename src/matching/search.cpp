// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/search.h"

#include "matching/cpu/distinct_features.h"
#include "matching/cpu/feature_search.h"
#include "matching/cpu/feature_space.h"
#include "matching/cpu/feature_tree.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl_flashreg {
namespace {

void
check(const char* name, const FeatureView& view)
{
  if (view.size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument(std::string(name) + ": size " +
                                std::to_string(view.size) +
                                " is out of range: it must fit 31 bits");
  if (view.size > 0 &&
      (!view.data || view.dimension == 0 || view.stride < view.dimension))
    throw std::invalid_argument(
        std::string(name) +
        ": needs data, a dimension >= 1 and a stride >= it; got "
        "dimension " +
        std::to_string(view.dimension) + ", stride " + std::to_string(view.stride));
}

} // namespace

void
checkSearch(const FeatureView& queries, const FeatureView& targets, std::size_t k)
{
  check("queries", queries);
  check("targets", targets);
  if (k == 0)
    throw std::invalid_argument("k = 0 is out of range: it must be >= 1");
  if (queries.size > 0 && targets.size > 0 && queries.dimension != targets.dimension)
    throw std::invalid_argument(
        "queries have dimension " + std::to_string(queries.dimension) +
        ", targets have dimension " + std::to_string(targets.dimension));
}

MutualMatches
searchFeatures(const FeatureView& queries,
               const FeatureView& targets,
               std::size_t k,
               bool both_ways,
               ThreadPool& pool)
{
  checkSearch(queries, targets, k);
  if (queries.size == 0 || targets.size == 0)
    return {};

  std::optional<DistinctFeatures> sides[2];
  pool.forEach(2, [&](std::size_t side, std::size_t) {
    sides[side].emplace(side == 0 ? queries : targets);
  });
  const DistinctFeatures &from = *sides[0], &to = *sides[1];
  if (from.size() == 0 || to.size() == 0)
    return {};
  const FeatureSpace space(from, to);
  const std::vector<FeatureTree> trees = plantTrees({&from, &to}, space, pool);
  const FeatureSet sets[2] = {{from, trees[0]}, {to, trees[1]}};
  const auto search = [&](const FeatureSet& side, const FeatureSet& other) {
    return searchNearest(side, other, TargetBlocks(other, space, pool), space, k, pool);
  };
  MutualMatches matches;
  matches.forward = search(sets[0], sets[1]);
  if (both_ways)
    matches.backward = search(sets[1], sets[0]);
  return matches;
}

std::vector<FeatureMatch>
MutualMatches::mutual() const
{
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(backward.size());
  for (const FeatureMatch& match : backward)
    pairs.emplace_back(match.match, match.query);
  std::sort(pairs.begin(), pairs.end());
  std::vector<FeatureMatch> both;
  for (const FeatureMatch& match : forward)
    if (std::binary_search(
            pairs.begin(), pairs.end(), std::make_pair(match.query, match.match)))
      both.push_back(match);
  return both;
}

} // namespace pcl_flashreg
