// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/map_report.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pcl_flashreg {
namespace {

using ScanPair = std::pair<std::size_t, std::size_t>;

std::vector<std::vector<std::size_t>>
inOrder(std::vector<std::vector<std::size_t>> groups)
{
  std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.size() > b.size() || (a.size() == b.size() && a.front() < b.front());
  });
  return groups;
}

} // namespace

MultiviewResult
reportOf(const Grouping& map,
         const std::vector<SurfaceEdge>& edges,
         const std::vector<PairVotes>& pairs,
         const MapScans& scans)
{
  MultiviewResult result;
  result.scans.resize(map.poses.size());
  result.groups = inOrder(map.groups);
  for (std::size_t g = 0; g < result.groups.size(); ++g) {
    const std::size_t first = result.groups[g].front();
    for (const std::size_t scan : result.groups[g]) {
      result.scans[scan].group = g;
      result.scans[scan].T_group_scan =
          betweenFrames(map.poses[first].inverse(Eigen::Isometry) * map.poses[scan],
                        *scans(first),
                        *scans(scan));
    }
  }
  std::map<ScanPair, MapEdge> all;
  for (const PairVotes& pair : pairs) {
    MapEdge& edge = all[{pair.target, pair.source}];
    const Vote& best = pair.votes.front();
    edge.T_target_source =
        betweenFrames(best.T_target_source, *scans(pair.target), *scans(pair.source));
    edge.pair_confidence = best.probability;
    edge.fate = result.scans[pair.target].group == result.scans[pair.source].group
                    ? EdgeFate::Disagrees
                    : EdgeFate::Apart;
  }
  for (const SurfaceEdge& found : edges) {
    const std::size_t target = found.constraint.target,
                      source = found.constraint.source;
    MapEdge& edge = all[{target, source}];
    edge.fate = EdgeFate::Used;
    edge.agreement = found.agreement;
    edge.T_target_source =
        betweenFrames(found.constraint.T_target_source, *scans(target), *scans(source));
    const auto off = residualOf(found.constraint, map.poses[target], map.poses[source]);
    edge.rotation_residual = off.head<3>().norm();
    edge.translation_residual = off.tail<3>().norm();
    ++result.scans[target].edges;
    ++result.scans[source].edges;
  }
  for (auto& [scans_of, edge] : all) {
    edge.target = scans_of.first;
    edge.source = scans_of.second;
    result.edges.push_back(edge);
  }
  return result;
}

} // namespace pcl_flashreg
