// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching.h"

#include <algorithm>
#include <utility>

namespace pcl_flashreg::align {
namespace {

void
keepMutual(std::vector<FeatureMatch>& matches,
           const std::vector<FeatureMatch>& backward)
{
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(backward.size());
  for (const FeatureMatch& match : backward)
    pairs.emplace_back(match.match, match.query);
  std::sort(pairs.begin(), pairs.end());
  const auto is_one_way = [&](const FeatureMatch& match) {
    return !std::binary_search(
        pairs.begin(), pairs.end(), std::make_pair(match.query, match.match));
  };
  matches.erase(std::remove_if(matches.begin(), matches.end(), is_one_way),
                matches.end());
}

} // namespace

RankedCorrespondences
matchPoints(const Eigen::Matrix3Xd& source_xyz,
            const FeatureView& source_features,
            const Eigen::Matrix3Xd& target_xyz,
            const FeatureView& target_features,
            std::size_t neighbors,
            bool mutual,
            unsigned num_threads)
{
  auto matches =
      matchFeatures(source_features, target_features, neighbors, num_threads);
  if (mutual)
    keepMutual(matches,
               matchFeatures(target_features, source_features, neighbors, num_threads));
  RankedCorrespondences result;
  const auto n = static_cast<Eigen::Index>(matches.size());
  result.points.source.resize(3, n);
  result.points.target.resize(3, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const FeatureMatch& match = matches[static_cast<std::size_t>(i)];
    result.points.source.col(i) = source_xyz.col(match.query);
    result.points.target.col(i) = target_xyz.col(match.match);
    result.ranks.push_back(match.squared_distance);
  }
  return result;
}

} // namespace pcl_flashreg::align
