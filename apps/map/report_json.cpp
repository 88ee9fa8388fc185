// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../program/json.h"
#include "../program/motion_options.h"
#include "report.h"

#include <pcl_flashreg/estimator.h>

namespace pcl_flashreg::map {
namespace {

using program::Json, program::rowsOf;

Json
poseOf(const RigidTransform& pose)
{
  return rowsOf(pose.toMatrix<double>());
}

Json
scanOf(const MapRun& run, std::size_t scan)
{
  const ScanPlace& place = run.result.scans[scan];
  const bool placed = isPlaced(run.result, scan);
  return {{"name", run.scans[scan].name},
          {"path", run.scans[scan].path},
          {"group", placed ? Json(place.group + 1) : Json()},
          {"transformation", placed ? poseOf(place.T_group_scan) : Json()},
          {"confidence", place.confidence},
          {"edges", place.edges}};
}

const char*
nameOf(EdgeFate fate)
{
  switch (fate) {
  case EdgeFate::Used:
    return "used";
  case EdgeFate::Disagrees:
    return "disagrees";
  default:
    return "apart";
  }
}

Json
edgeOf(const MapEdge& edge)
{
  Json json = {{"target", edge.target},
               {"source", edge.source},
               {"fate", nameOf(edge.fate)},
               {"transformation", poseOf(edge.T_target_source)},
               {"pair_confidence", edge.pair_confidence},
               {"rotation_residual", edge.rotation_residual},
               {"translation_residual", edge.translation_residual}};
  if (edge.fate == EdgeFate::Used) {
    json["confidence"] = edge.confidence;
    json["matched"] = edge.agreement.matched;
    json["contradicted"] = edge.agreement.contradicted;
    json["residual"] = edge.agreement.residual;
    json["information"] = rowsOf(edge.information);
  }
  return json;
}

Json
timesOf(const MapRun& run)
{
  return {{"reading", run.times.reading},
          {"relations", run.times.relations},
          {"placing", run.times.placing},
          {"grouping", run.result.timings.grouping},
          {"refinement", run.result.timings.refinement},
          {"writing", run.times.writing},
          {"total", run.times.total}};
}

} // namespace

std::string
formatJson(const MapRun& run, WithTimes times)
{
  Json json;
  json["version"] = version();
  json["complete"] = isComplete(run);
  json["placed"] = run.result.placed();
  json["resolution"] = run.resolution;
  json["min_confidence"] = run.min_confidence;
  json["motion"] = program::nameOf(run.motion);
  json["pairs"] = run.pairs;
  json["scans"] = Json::array();
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    json["scans"].push_back(scanOf(run, i));
  json["left_out"] = Json::array();
  for (const LeftOutFile& file : run.left_out)
    json["left_out"].push_back({{"path", file.path}, {"reason", file.reason}});
  json["groups"] = Json::array();
  for (std::size_t map = 0; map < numberOfMaps(run.result); ++map)
    json["groups"].push_back(run.result.groups[map]);
  json["edges"] = Json::array();
  for (const MapEdge& edge : run.result.edges)
    json["edges"].push_back(edgeOf(edge));
  if (times == WithTimes::Yes)
    json["timings_ms"] = timesOf(run);
  return program::textOf(json);
}

} // namespace pcl_flashreg::map
