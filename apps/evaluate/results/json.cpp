// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../../program/json.h"
#include "report.h"

#include <cmath>

namespace pcl_flashreg::evaluate {
namespace {

using program::Json;

Json
toJson(const Average& average)
{
  return {{"mean", average.mean}, {"median", average.median}};
}

Json
toJson(const Spread& spread)
{
  return {{"median", spread.median}, {"p95", spread.p95}};
}

/** \brief A share of nothing is null. */
Json
toJson(double share)
{
  return std::isfinite(share) ? Json(share) : Json();
}

Json
toJson(const MethodSummary& m)
{
  Json times = {{"features", toJson(m.features_ms)},
                {"matching", toJson(m.matching_ms)},
                {"estimation", toJson(m.estimation_ms)}};
  for (const StageSpread& stage : m.stages_ms)
    times[stage.name] = toJson(stage.spread);
  return {{"method", m.method},
          {"successes", m.successes},
          {"recall", toJson(m.recall)},
          {"rotation_error_deg", toJson(m.rotation_error)},
          {"translation_error", toJson(m.translation_error)},
          {"verdict",
           {{"trusted", m.trusted},
            {"precision", toJson(m.precision)},
            {"recall", toJson(m.verdict_recall)}}},
          {"recall_difference", toJson(m.recall_difference)},
          {"times_ms", times},
          {"time_ratio", toJson(m.time_ratio)}};
}

Json
toJson(const GroupSummary& group)
{
  Json methods = Json::array();
  for (const MethodSummary& method : group.methods)
    methods.push_back(toJson(method));
  return {{"dataset", group.dataset.empty() ? Json() : Json(group.dataset)},
          {"scene", group.scene.empty() ? Json() : Json(group.scene)},
          {"pairs", group.pairs},
          {"correspondences", toJson(group.correspondences)},
          {"inlier_ratio", toJson(group.inlier_ratio)},
          {"methods", methods}};
}

Json
toJson(const MapSummary& map)
{
  return {{"name", map.name},
          {"scans", map.scans},
          {"placed", map.placed},
          {"groups", map.groups},
          {"tried", map.tried},
          {"used_edges", map.used_edges},
          {"wrong_edges", map.wrong_edges},
          {"unknown_edges", map.unknown_edges},
          {"seconds", map.seconds}};
}

} // namespace

std::string
formatJson(const Config& config,
           const std::vector<GroupSummary>& groups,
           const std::vector<MapSummary>& maps)
{
  Json json;
  json["config"] = config;
  json["groups"] = Json::array();
  for (const GroupSummary& group : groups)
    json["groups"].push_back(toJson(group));
  for (const MapSummary& map : maps)
    json["maps"].push_back(toJson(map));
  return program::textOf(json);
}

} // namespace pcl_flashreg::evaluate
