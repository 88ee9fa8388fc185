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

/** \brief Surfaces that touch, but only if the scan is turned by more than this (radians) from
 * where the map has it, say nothing that anybody vouches for. */
constexpr double MOST_TURNED = 0.1;

std::vector<std::vector<std::size_t>>
inOrder(std::vector<std::vector<std::size_t>> groups)
{
  std::sort(groups.begin(), groups.end(), [](const auto& a, const auto& b) {
    return a.size() > b.size() || (a.size() == b.size() && a.front() < b.front());
  });
  return groups;
}

/** \brief Of small motions about the origin of the target's frame, from those about the middle
 * of what touches. */
InformationMatrix
informationOf(const PoseConstraint& constraint, const Eigen::Vector3d& target_middle)
{
  const Eigen::Vector3d arm = target_middle + constraint.middle;
  Eigen::Matrix<double, 6, 6> to_middle = Eigen::Matrix<double, 6, 6>::Identity();
  to_middle.bottomLeftCorner<3, 3>() = -crossMatrix(arm);
  return constraint.weight * to_middle.transpose() * constraint.hessian * to_middle;
}

} // namespace

MultiviewResult
reportOf(const Grouping& map,
         const std::vector<SurfaceEdge>& edges,
         const std::vector<PairVotes>& pairs,
         const std::vector<double>& confidences,
         const MapScans& scans)
{
  MultiviewResult result;
  result.scans.resize(map.poses.size());
  result.groups = inOrder(map.groups);
  for (std::size_t g = 0; g < result.groups.size(); ++g) {
    const std::size_t first = result.groups[g].front();
    for (const std::size_t scan : result.groups[g]) {
      result.scans[scan].group = g;
      result.scans[scan].confidence = confidences[scan];
      result.scans[scan].T_group_scan =
          betweenFrames(map.poses[first].inverse(Eigen::Isometry) * map.poses[scan],
                        scans[first],
                        scans[scan]);
    }
  }
  std::map<ScanPair, MapEdge> all;
  for (const PairVotes& pair : pairs) {
    MapEdge& edge = all[{pair.target, pair.source}];
    const Vote& best = pair.votes.front();
    edge.T_target_source =
        betweenFrames(best.T_target_source, scans[pair.target], scans[pair.source]);
    edge.pair_confidence = best.probability;
    edge.fate = result.scans[pair.target].group == result.scans[pair.source].group
                    ? EdgeFate::Disagrees
                    : EdgeFate::Apart;
  }
  for (const SurfaceEdge& found : edges) {
    const std::size_t target = found.constraint.target,
                      source = found.constraint.source;
    const auto off = residualOf(found.constraint, map.poses[target], map.poses[source]);
    if (found.probability == 0 && off.head<3>().norm() > MOST_TURNED)
      continue;
    MapEdge& edge = all[{target, source}];
    edge.fate = EdgeFate::Used;
    edge.agreement = found.agreement;
    edge.pair_confidence = found.probability;
    edge.confidence = std::min(confidences[target], confidences[source]);
    edge.information = informationOf(found.constraint, scans[target].middle);
    edge.T_target_source =
        betweenFrames(found.constraint.T_target_source, scans[target], scans[source]);
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
