// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The order of the steps, from scans to a map.

#include <pcl_flashreg/multiview_registration.h>

#include "multiview/map_report.h"
#include "multiview/pair_choice.h"
#include "multiview/map_refinement.h"
#include "multiview/grouping.h"
#include "multiview/relation.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <algorithm>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace {

void
checkOptions(const MultiviewOptions& options)
{
  if (!(options.min_confidence > 0 && options.min_confidence < 1))
    throw std::invalid_argument("min_confidence is " +
                                std::to_string(options.min_confidence) +
                                ", but must be in (0, 1)");
  if (options.alike == 0)
    throw std::invalid_argument("alike is 0, but must be >= 1");
}

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

/** \brief Times that scans are taken out which the finished map does not confirm, and with what
 * confidence they leave to be placed anew. */
constexpr int RECONSIDERED = 3;
constexpr double LEAST_TO_STAY = 0.5;

} // namespace

class MultiviewRegistration::Impl {
public:
  Impl(BackendKind backend, unsigned num_threads) : pool(num_threads)
  {
    for (std::size_t i = 0; i < pool.size(); ++i)
      workers.emplace_back(backend, 1);
  }

  ThreadPool pool;
  /** \brief One a thread. */
  std::vector<PairRegistration> workers;
};

MultiviewRegistration::MultiviewRegistration(BackendKind backend, unsigned num_threads)
    : impl_(std::make_unique<Impl>(backend, num_threads))
{
}

MultiviewRegistration::~MultiviewRegistration() = default;
MultiviewRegistration::MultiviewRegistration(MultiviewRegistration&&) noexcept =
    default;
MultiviewRegistration&
MultiviewRegistration::operator=(MultiviewRegistration&&) noexcept = default;

std::vector<MultiviewRegistration::ScanPair>
MultiviewRegistration::allPairs(std::size_t scans)
{
  std::vector<ScanPair> pairs;
  for (std::size_t target = 0; target < scans; ++target)
    for (std::size_t source = target + 1; source < scans; ++source)
      pairs.emplace_back(target, source);
  return pairs;
}

std::vector<MultiviewRegistration::ScanPair>
MultiviewRegistration::choosePairs(std::size_t count,
                                   const ScanSource& scans,
                                   const MultiviewOptions& options)
{
  checkOptions(options);
  return firstPairs(Likeness(count, scans, impl_->pool), count, options);
}

std::vector<MultiviewRegistration::ScanPair>
MultiviewRegistration::choosePairs(const ScanSource& scans,
                                   const std::vector<ScanRelation>& tried,
                                   const MultiviewResult& map,
                                   const MultiviewOptions& options)
{
  checkOptions(options);
  if (map.groups.size() < 2)
    return {};
  const Likeness likeness(map.scans.size(), scans, impl_->pool);
  return untiedPairs(likeness, tried, map, options);
}

std::vector<ScanRelation>
MultiviewRegistration::relate(const ScanSource& scans,
                              const std::vector<ScanPair>& pairs,
                              const MultiviewOptions& options)
{
  checkOptions(options);
  const PairOptions pair_options = withRivals(options.pair);
  std::vector<ScanRelation> relations(pairs.size());
  std::mutex reporting;
  std::size_t done = 0;
  impl_->pool.forEach(pairs.size(), [&](std::size_t i, std::size_t thread) {
    const auto [target, source] = pairs[i];
    relations[i].target = target;
    relations[i].source = source;
    const Result result =
        impl_->workers[thread].align(scans(source), scans(target), pair_options).pose;
    relations[i].poses = posesOf(result);
    relations[i].overruled_viewpoints = result.evidence.overruled_viewpoints;
    if (options.on_relation) {
      const std::lock_guard lock(reporting);
      options.on_relation(relations[i], ++done, pairs.size());
    }
  });
  return relations;
}

MultiviewResult
MultiviewRegistration::place(std::size_t count,
                             const ScanSource& source,
                             const std::vector<ScanRelation>& relations,
                             const MultiviewOptions& options)
{
  checkOptions(options);
  checkRelations(count, relations);
  const detail::Stopwatch total;
  MultiviewTimings timings;
  std::vector<std::shared_ptr<const MapScan>> surfaces(count);
  const std::vector<bool> blind = falseViewpoints(count, relations);
  impl_->pool.forEach(count, [&](std::size_t i, std::size_t) {
    const Scan scan = source(i);
    surfaces[i] = std::make_shared<MapScan>(blind[i] || scan.viewpointSource() ==
                                                            ViewpointSource::Points
                                                ? scan.withoutViewpoint()
                                                : scan);
  });
  const MapScans scans = [&](std::size_t i) { return surfaces[i]; };
  const std::vector<PairVotes> pairs = votesOf(relations, scans);
  Grouping map =
      joinGroups(scans, pairs, apart(count), options.min_confidence, impl_->pool);
  for (int round = 0; round < RECONSIDERED; ++round) {
    for (const std::vector<std::size_t>& group : map.groups)
      refineMap(scans, within(group, pairs), group, map.poses, impl_->pool);
    const std::size_t released =
        releaseDoubtful(scans, pairs, LEAST_TO_STAY, map, impl_->pool);
    const std::size_t groups = map.groups.size();
    map = joinGroups(scans, pairs, std::move(map), options.min_confidence, impl_->pool);
    if (released == 0 && map.groups.size() == groups)
      break;
  }
  // Who is in may be in twice the doubt of who comes in.
  const double least_to_remain = 1 - 2 * (1 - options.min_confidence);
  releaseDoubtful(scans, pairs, least_to_remain, map, impl_->pool);
  timings.grouping = total.milliseconds();
  std::vector<SurfaceEdge> edges;
  for (const std::vector<std::size_t>& group : map.groups)
    for (SurfaceEdge& edge :
         refineMap(scans, within(group, pairs), group, map.poses, impl_->pool))
      edges.push_back(std::move(edge));
  askClouds(scans, edges, impl_->pool);
  timings.refinement = total.milliseconds() - timings.grouping;
  MultiviewResult result =
      reportOf(map, edges, pairs, confidencesOf(scans, pairs, map, impl_->pool), scans);
  timings.total = total.milliseconds();
  result.timings = timings;
  return result;
}

MultiviewResult
MultiviewRegistration::align(const std::vector<Scan>& scans,
                             const MultiviewOptions& options)
{
  const detail::Stopwatch watch;
  const ScanSource source = [&](std::size_t i) { return scans[i]; };
  std::vector<ScanRelation> relations;
  MultiviewResult result;
  MultiviewTimings spent;
  std::vector<ScanPair> pairs = choosePairs(scans.size(), source, options);
  do {
    const detail::Stopwatch relating;
    for (ScanRelation& relation : relate(source, pairs, options))
      relations.push_back(std::move(relation));
    spent.relations += relating.milliseconds();
    result = place(scans.size(), source, relations, options);
    spent.grouping += result.timings.grouping;
    spent.refinement += result.timings.refinement;
    pairs = choosePairs(source, relations, result, options);
  } while (!pairs.empty());
  spent.total = watch.milliseconds();
  result.timings = spent;
  return result;
}

std::size_t
MultiviewResult::placed() const
{
  std::size_t count = 0;
  for (const std::vector<std::size_t>& group : groups)
    count += group.size() > 1 ? group.size() : 0;
  return count;
}

} // namespace pcl_flashreg
