// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching.h"

namespace pcl_flashreg::align {
RankedCorrespondences
matchPoints(const Eigen::Matrix3Xd& source_xyz,
            const FeatureView& source_features,
            const Eigen::Matrix3Xd& target_xyz,
            const FeatureView& target_features,
            std::size_t neighbors,
            bool mutual,
            unsigned num_threads)
{
  const auto matches =
      mutual ? matchFeaturesBothWays(
                   source_features, target_features, neighbors, num_threads)
                   .mutual()
             : matchFeatures(source_features, target_features, neighbors, num_threads);
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
