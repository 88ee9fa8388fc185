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

/** \brief Optimizes those poses of a map that constraints are about.
 * \param[in] constraints with numbers of scans */
void
optimizeGroup(std::vector<PoseConstraint> constraints,
              const std::vector<std::size_t>& group,
              MapPoses& poses)
{
  const auto positionOf = [&](std::size_t scan) {
    return static_cast<std::size_t>(std::lower_bound(group.begin(), group.end(), scan) -
                                    group.begin());
  };
  for (PoseConstraint& constraint : constraints) {
    constraint.target = positionOf(constraint.target);
    constraint.source = positionOf(constraint.source);
  }
  MapPoses of_group;
  for (const std::size_t scan : group)
    of_group.push_back(poses[scan]);
  optimize(constraints, of_group);
  for (std::size_t i = 0; i < group.size(); ++i)
    poses[group[i]] = of_group[i];
}

/** \brief The pose that a pair speaks for and that agrees with the map's. */
std::optional<SurfaceEdge>
agreeing(const MapScans& scans, const PairVotes& pair, const MapPoses& poses)
{
  const auto target = scans(pair.target), source = scans(pair.source);
  const Eigen::Isometry3d by_map =
      poses[pair.target].inverse(Eigen::Isometry) * poses[pair.source];
  for (const Vote& vote : pair.votes) {
    if (!samePlace(by_map, vote.T_target_source, target->spacing))
      continue;
    std::optional<PoseConstraint> constraint =
        surfaceConstraint(*target, *source, vote.T_target_source);
    if (!constraint)
      return std::nullopt;
    constraint->target = pair.target;
    constraint->source = pair.source;
    constraint->weight *= vote.probability;
    const SurfacePair clouds{
        source->surface,
        target->surface,
        static_cast<float>(std::max(target->spacing, source->spacing))};
    return SurfaceEdge{
        *constraint,
        Look(clouds, POINTS, TOLERANCE, MARGIN)(toPose(vote.T_target_source)),
        vote.probability};
  }
  return std::nullopt;
}

/** \brief Two scans as they lie in the map, moved onto each other; nothing where they don't
 * touch, or the surfaces say otherwise. */
std::optional<SurfaceEdge>
touching(const MapScan& target, const MapScan& source, const Eigen::Isometry3d& by_map)
{
  const SurfacePair clouds{
      source.surface,
      target.surface,
      static_cast<float>(std::max(target.spacing, source.spacing))};
  const Look look(clouds, POINTS, TOLERANCE, MARGIN);
  if (look(toPose(by_map)).matched < LEAST_MATCHED / 2)
    return std::nullopt;
  SurfaceEdge edge;
  const Eigen::Isometry3d moved = toIsometry(moveOntoTarget(clouds, toPose(by_map)));
  edge.agreement = look(toPose(moved));
  if (edge.agreement.matched < LEAST_MATCHED ||
      edge.agreement.contradicted > MOST_CONTRADICTED * edge.agreement.matched ||
      !samePlace(by_map, moved, clouds.spacing))
    return std::nullopt;
  std::optional<PoseConstraint> constraint = surfaceConstraint(target, source, moved);
  if (!constraint)
    return std::nullopt;
  edge.constraint = std::move(*constraint);
  edge.constraint.weight *= 0.1;
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
      if (apart.norm() < scans(group[a])->radius + scans(group[b])->radius)
        near.emplace_back(group[a], group[b]);
    }
  return near;
}

template <typename Value>
std::vector<Value>
present(std::vector<std::optional<Value>>& values)
{
  std::vector<Value> result;
  for (std::optional<Value>& value : values)
    if (value)
      result.push_back(std::move(*value));
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
  std::vector<PoseConstraint> constraints;
  for (const std::optional<SurfaceEdge>& edge : edges)
    if (edge)
      constraints.push_back(edge->constraint);
  optimizeGroup(constraints, group, poses);
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
      const auto [target, source] = near[i];
      const auto pair = votes.find(near[i]);
      if (pair != votes.end())
        found[i] = agreeing(scans, *pair->second, poses);
      if (!found[i])
        found[i] = touching(*scans(target),
                            *scans(source),
                            poses[target].inverse(Eigen::Isometry) * poses[source]);
      if (found[i]) {
        found[i]->constraint.target = target;
        found[i]->constraint.source = source;
      }
    });
    edges = present(found);
    std::vector<PoseConstraint> constraints;
    for (const SurfaceEdge& edge : edges)
      constraints.push_back(edge.constraint);
    optimizeGroup(constraints, group, poses);
  }
  return edges;
}

} // namespace pcl_flashreg
