// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/map_builder.h"

#include "multiview/map_refinement.h"
#include "multiview/map_report.h"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Times that scans are taken out which the finished map does not confirm, and with what
 * confidence they leave to be placed anew. */
constexpr int RECONSIDERED = 3;
constexpr double LEAST_TO_STAY = 0.5;

void
checkRelations(std::size_t count, const std::vector<ScanRelation>& relations)
{
  std::set<std::pair<std::size_t, std::size_t>> seen;
  for (const ScanRelation& relation : relations) {
    const std::string pair =
        std::to_string(relation.target) + " and " + std::to_string(relation.source);
    if (relation.target == relation.source ||
        std::max(relation.target, relation.source) >= count)
      throw std::invalid_argument("relation between scans " + pair + ": there are " +
                                  std::to_string(count) + ", and a pair has two");
    if (!seen.insert({relation.target, relation.source}).second)
      throw std::invalid_argument("two relations between scans " + pair);
  }
}

/** \brief Every scan by itself. */
Grouping
apart(std::size_t count)
{
  Grouping grouping;
  grouping.poses.assign(count, Eigen::Isometry3d::Identity());
  for (std::size_t i = 0; i < count; ++i)
    grouping.groups.push_back({i});
  return grouping;
}

/** \brief Scans whose sensor was elsewhere than they say: pairs that are certain, most of
 * them, are so in spite of the viewpoints. Where both scans of a pair may be to blame, it is
 * the one that more pairs blame. */
std::vector<bool>
falseViewpoints(std::size_t count, const std::vector<ScanRelation>& relations)
{
  constexpr double CERTAIN = 0.6, MOST = 0.5;
  std::vector<double> all(count), overruled(count);
  for (const ScanRelation& relation : relations)
    if (!relation.poses.empty() && relation.poses.front().probability > CERTAIN)
      for (const std::size_t scan : {relation.target, relation.source}) {
        ++all[scan];
        overruled[scan] += relation.overruled_viewpoints ? 1 : 0;
      }
  std::vector<bool> result(count);
  for (std::size_t i = 0; i < count; ++i)
    result[i] = overruled[i] > MOST * all[i];
  return result;
}

/** \brief Pairs of scans of a group. */
std::vector<const PairVotes*>
within(const std::vector<std::size_t>& group, const std::vector<PairVotes>& pairs)
{
  std::vector<const PairVotes*> result;
  for (const PairVotes& pair : pairs)
    if (std::binary_search(group.begin(), group.end(), pair.target) &&
        std::binary_search(group.begin(), group.end(), pair.source))
      result.push_back(&pair);
  return result;
}

} // namespace

MapBuilder::MapBuilder(std::size_t count,
                       MultiviewRegistration::ScanSource scans,
                       double min_confidence,
                       ThreadPool& pool)
    : min_confidence_(min_confidence),
      pool_(pool),
      scans_(count, std::move(scans), pool),
      map_(apart(count))
{
}

void
MapBuilder::add(std::vector<ScanRelation> relations)
{
  for (ScanRelation& relation : relations) {
    // Where no pose was found, there is no vote, and the map stays as it is.
    has_news_ = has_news_ || !relation.poses.empty();
    relations_.push_back(std::move(relation));
  }
  checkRelations(scans_.size(), relations_);
}

void
MapBuilder::group()
{
  if (!std::exchange(has_news_, false))
    return;
  scans_.setBlind(falseViewpoints(scans_.size(), relations_));
  pairs_ = votesOf(relations_, scans_.all());
  map_ = joinGroups(scans_, pairs_, apart(scans_.size()), min_confidence_, pool_);
  std::vector<double> confidences;
  for (int round = 0; round < RECONSIDERED; ++round) {
    for (const std::vector<std::size_t>& group : map_.groups)
      refineMap(scans_, within(group, pairs_), group, map_.poses, pool_);
    confidences = confidencesOf(scans_, pairs_, map_, pool_);
    if (!reconsider(confidences))
      break;
    confidences.clear();
  }
  if (confidences.empty())
    confidences = confidencesOf(scans_, pairs_, map_, pool_);
  // Who is in may be in twice the doubt of who comes in.
  const double least_to_remain = 1 - 2 * (1 - min_confidence_);
  releaseDoubtful(scans_, pairs_, confidences, least_to_remain, map_);
}

/** \brief Takes out who is in doubt, and places them anew.
 * \return whether that changed the map */
bool
MapBuilder::reconsider(const std::vector<double>& confidences)
{
  const std::vector<std::vector<std::size_t>> before = map_.groups;
  releaseDoubtful(scans_, pairs_, confidences, LEAST_TO_STAY, map_);
  const bool released = map_.groups != before;
  const std::size_t groups = map_.groups.size();
  map_ = joinGroups(scans_, pairs_, std::move(map_), min_confidence_, pool_);
  return released || map_.groups.size() != groups;
}

MultiviewResult
MapBuilder::finish()
{
  std::vector<SurfaceEdge> edges;
  for (const std::vector<std::size_t>& group : map_.groups)
    for (SurfaceEdge& edge :
         refineMap(scans_, within(group, pairs_), group, map_.poses, pool_))
      edges.push_back(std::move(edge));
  askClouds(scans_, edges, pool_);
  return reportOf(
      map_, edges, pairs_, confidencesOf(scans_, pairs_, map_, pool_), scans_);
}

} // namespace pcl_flashreg
