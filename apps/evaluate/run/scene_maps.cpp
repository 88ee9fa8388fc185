// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scene_maps.h"

#include "../../map/groups.h"
#include "../results/judge.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <algorithm>

namespace pcl_flashreg::evaluate {
namespace {

std::vector<const Pair*>
pairsOf(const Job& job)
{
  std::vector<const Pair*> pairs;
  for (const std::size_t i : job.pairs)
    pairs.push_back(&job.data.pairs[i]);
  return pairs;
}

RigidTransform
between(const ScanPlace& target, const ScanPlace& source)
{
  const Eigen::Matrix3d R = target.T_group_scan.rotation.transpose();
  return {R * source.T_group_scan.rotation,
          R * (source.T_group_scan.translation - target.T_group_scan.translation)};
}

bool
hasUsedEdge(const MultiviewResult& result, std::size_t a, std::size_t b)
{
  return std::any_of(
      result.edges.begin(), result.edges.end(), [&](const MapEdge& edge) {
        return edge.fate == EdgeFate::Used &&
               std::minmax(edge.source, edge.target) == std::minmax(a, b);
      });
}

} // namespace

SceneMaps::SceneMaps(const Options& options, const Job& job)
    : job_(job),
      registration_(BackendKind::Auto, options.threads),
      truth_(pairsOf(job)),
      sets_(cloudSets(pairsOf(job))),
      maps_(sets_.size())
{
  options_.pair.resolution = job.data.leaf;
  options_.pair.parameters = job.parameters;
  options_.pair.neighbors = options.neighbors;
  for (std::size_t s = 0; s < sets_.size(); ++s)
    for (std::size_t i = 0; i < sets_[s].clouds.size(); ++i)
      places_[sets_[s].clouds[i]] = {s, i};
}

Answer
SceneMaps::answer(const Pair& pair, FeatureStore& store)
{
  const auto [set, source] = places_.at(pair.source);
  const std::size_t target = places_.at(pair.target).second;
  const Map& map = mapOf(set, store);
  const ScanPlace& source_place = map.result.scans[source];
  const ScanPlace& target_place = map.result.scans[target];
  Answer answer;
  answer.estimation_ms =
      1000 * map.summary.seconds /
      static_cast<double>(std::max<std::size_t>(1, map.summary.tried));
  const bool overlaps = pair.T_target_source.translation.allFinite();
  if (source_place.group != target_place.group ||
      (!overlaps && !hasUsedEdge(map.result, source, target)))
    return answer;
  answer.found = answer.trusted = true;
  answer.T_target_source = between(target_place, source_place);
  answer.confidence = std::min(source_place.confidence, target_place.confidence);
  return answer;
}

std::vector<MapSummary>
SceneMaps::summaries() const
{
  std::vector<MapSummary> result;
  for (const std::optional<Map>& map : maps_)
    if (map)
      result.push_back(map->summary);
  return result;
}

const SceneMaps::Map&
SceneMaps::mapOf(std::size_t number, FeatureStore& store)
{
  std::optional<Map>& map = maps_[number];
  if (map)
    return *map;
  const CloudSet& set = sets_[number];
  std::vector<Scan> scans;
  for (const std::string& cloud : set.clouds)
    scans.push_back(store.get(cloud)->scan);
  map.emplace();
  MapSummary& summary = map->summary;
  summary.name = set.name;
  summary.scans = scans.size();
  MultiviewOptions options = options_;
  options.on_relation = [&](const ScanRelation&, std::size_t, std::size_t) {
    ++summary.tried;
  };
  const detail::Stopwatch stopwatch;
  map->result = registration_.align(scans, options);
  summary.seconds = stopwatch.milliseconds() / 1000;
  summary.placed = map->result.placed();
  summary.groups = map::numberOfMaps(map->result);
  judgeEdges(set, *map);
  return *map;
}

void
SceneMaps::judgeEdges(const CloudSet& set, Map& map) const
{
  Criterion gross = job_.data.criterion;
  gross.max_translation *= 2;
  for (const MapEdge& edge : map.result.edges) {
    if (edge.fate != EdgeFate::Used)
      continue;
    ++map.summary.used_edges;
    const auto truth = truth_.between(set.clouds[edge.target], set.clouds[edge.source]);
    if (!truth) {
      ++map.summary.unknown_edges;
      continue;
    }
    Answer answer;
    answer.found = true;
    answer.T_target_source =
        between(map.result.scans[edge.target], map.result.scans[edge.source]);
    Record record;
    judge(answer, *truth, gross, record);
    map.summary.wrong_edges += record.success ? 0 : 1;
  }
}

} // namespace pcl_flashreg::evaluate
