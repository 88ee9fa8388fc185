// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/map_refinement.h"

#include "judgement/cpu/agreement.h"
#include "judgement/cpu/plane_alignment.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

namespace pcl_flashreg {
namespace {

constexpr int ROUNDS = 2;

/** \brief See Look. */
constexpr std::size_t POINTS = 512;
constexpr float TOLERANCE = 1.5f, MARGIN = 2;

/** \brief Scans touch if so large a share of their points match. */
constexpr double LEAST_MATCHED = 0.02;
/** \brief Contradicted over matched, at most. */
constexpr double MOST_CONTRADICTED = 0.3;

/** \brief By how much surfaces count that no pair speaks for. */
constexpr double UNVOUCHED = 0.1;

CloudAgreement
agreementOf(const SurfacePair& clouds, const Eigen::Isometry3d& T)
{
  return Look(clouds, POINTS, TOLERANCE, MARGIN)(toPose(T));
}

/** \brief Optimizes those poses of a map that edges are about. */
void
optimizeGroup(const std::vector<SurfaceEdge>& edges,
              const std::vector<std::size_t>& group,
              MapPoses& poses)
{
  const auto positionOf = [&](std::size_t scan) {
    return static_cast<std::size_t>(std::lower_bound(group.begin(), group.end(), scan) -
                                    group.begin());
  };
  std::vector<PoseConstraint> constraints;
  for (const SurfaceEdge& edge : edges) {
    constraints.push_back(edge.constraint);
    constraints.back().target = positionOf(edge.constraint.target);
    constraints.back().source = positionOf(edge.constraint.source);
  }
  MapPoses of_group;
  for (const std::size_t scan : group)
    of_group.push_back(poses[scan]);
  optimize(constraints, of_group);
  for (std::size_t i = 0; i < group.size(); ++i)
    poses[group[i]] = of_group[i];
}

/** \brief Two scans of a map, under a pose of their own. */
std::optional<SurfaceEdge>
edgeBetween(const MapScans& scans,
            std::size_t target,
            std::size_t source,
            const Eigen::Isometry3d& T_target_source)
{
  std::optional<PoseConstraint> constraint =
      surfaceConstraint(scans.clouds(source, target).pair(), T_target_source);
  if (!constraint)
    return std::nullopt;
  constraint->target = target;
  constraint->source = source;
  SurfaceEdge edge;
  edge.constraint = std::move(*constraint);
  return edge;
}

/** \brief The pose that a pair speaks for and that agrees with the map's. */
std::optional<SurfaceEdge>
agreeing(const MapScans& scans, const PairVotes& pair, const MapPoses& poses)
{
  const Eigen::Isometry3d by_map =
      poses[pair.target].inverse(Eigen::Isometry) * poses[pair.source];
  const double spacing = scans[pair.target].spacing;
  for (const Vote& vote : pair.votes) {
    if (!samePlace(by_map, vote.T_target_source, spacing))
      continue;
    auto edge = edgeBetween(scans, pair.target, pair.source, vote.T_target_source);
    if (edge) {
      edge->constraint.weight *= vote.probability;
      edge->probability = vote.probability;
    }
    return edge;
  }
  return std::nullopt;
}

/** \brief Two scans as they lie in the map, moved onto each other; nothing where they don't
 * touch, or the surfaces say otherwise. */
std::optional<SurfaceEdge>
touching(const MapScans& scans,
         std::size_t target,
         std::size_t source,
         const MapPoses& poses)
{
  const Eigen::Isometry3d by_map =
      poses[target].inverse(Eigen::Isometry) * poses[source];
  const TwoClouds two = scans.clouds(source, target);
  const SurfacePair clouds = two.pair();
  if (agreementOf(clouds, by_map).matched < LEAST_MATCHED / 2)
    return std::nullopt;
  const Eigen::Isometry3d moved = toIsometry(moveOntoTarget(clouds, toPose(by_map)));
  const CloudAgreement agreement = agreementOf(clouds, moved);
  if (agreement.matched < LEAST_MATCHED ||
      agreement.contradicted > MOST_CONTRADICTED * agreement.matched ||
      !samePlace(by_map, moved, clouds.spacing))
    return std::nullopt;
  auto edge = edgeBetween(scans, target, source, moved);
  if (edge)
    edge->constraint.weight *= UNVOUCHED;
  return edge;
}

/** \brief Scans of the group that are near enough to touch: targets and sources. */
std::vector<std::pair<std::size_t, std::size_t>>
pairsInReach(const MapScans& scans,
             const std::vector<std::size_t>& group,
             const MapPoses& poses)
{
  std::vector<std::pair<std::size_t, std::size_t>> near;
  for (std::size_t a = 0; a < group.size(); ++a)
    for (std::size_t b = a + 1; b < group.size(); ++b) {
      const Eigen::Vector3d apart =
          poses[group[a]].translation() - poses[group[b]].translation();
      if (apart.norm() < scans[group[a]].radius + scans[group[b]].radius)
        near.emplace_back(group[a], group[b]);
    }
  return near;
}

std::vector<SurfaceEdge>
present(std::vector<std::optional<SurfaceEdge>>& edges)
{
  std::vector<SurfaceEdge> result;
  for (std::optional<SurfaceEdge>& edge : edges)
    if (edge)
      result.push_back(std::move(*edge));
  return result;
}

} // namespace

void
settlePoses(const MapScans& scans,
            const std::vector<const PairVotes*>& pairs,
            const std::vector<std::size_t>& group,
            MapPoses& poses,
            ThreadPool& pool)
{
  std::vector<std::optional<SurfaceEdge>> edges(pairs.size());
  pool.forEach(pairs.size(), [&](std::size_t i, std::size_t) {
    edges[i] = agreeing(scans, *pairs[i], poses);
  });
  optimizeGroup(present(edges), group, poses);
}

std::vector<SurfaceEdge>
refineMap(const MapScans& scans,
          const std::vector<const PairVotes*>& pairs,
          const std::vector<std::size_t>& group,
          MapPoses& poses,
          ThreadPool& pool)
{
  std::map<std::pair<std::size_t, std::size_t>, const PairVotes*> votes;
  for (const PairVotes* pair : pairs)
    votes[{pair->target, pair->source}] = pair;
  std::vector<SurfaceEdge> edges;
  for (int round = 0; round < ROUNDS; ++round) {
    const std::vector<std::pair<std::size_t, std::size_t>> near =
        pairsInReach(scans, group, poses);
    std::vector<std::optional<SurfaceEdge>> found(near.size());
    pool.forEach(near.size(), [&](std::size_t i, std::size_t) {
      const auto pair = votes.find(near[i]);
      if (pair != votes.end())
        found[i] = agreeing(scans, *pair->second, poses);
      if (!found[i])
        found[i] = touching(scans, near[i].first, near[i].second, poses);
    });
    edges = present(found);
    optimizeGroup(edges, group, poses);
  }
  return edges;
}

void
askClouds(const MapScans& scans, std::vector<SurfaceEdge>& edges, ThreadPool& pool)
{
  pool.forEach(edges.size(), [&](std::size_t i, std::size_t) {
    const PoseConstraint& constraint = edges[i].constraint;
    edges[i].agreement =
        agreementOf(scans.clouds(constraint.source, constraint.target).pair(),
                    constraint.T_target_source);
  });
}

} // namespace pcl_flashreg
