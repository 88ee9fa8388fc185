// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../program/json.h"
#include "../program/motion_options.h"
#include "../program/pair_json.h"
#include "report.h"

#include <pcl_flashreg/estimator.h>

#include <algorithm>

namespace pcl_flashreg::align {
namespace {

using program::Json, program::rowsOf;

Json
timingsOf(const Outcome& outcome)
{
  Json timings = Json::object();
  for (const Step& step : stepsOf(outcome)) {
    std::string name = step.name;
    std::replace(name.begin(), name.end(), ' ', '_');
    if (!step.of_estimator)
      timings[name] = step.milliseconds;
  }
  const StageTimings& stages = outcome.pair.timings.estimation;
  for (const Stage& stage : STAGES)
    timings[stage.name] = stages.*stage.milliseconds;
  timings["estimation"] = stages.total;
  timings["total"] = outcome.total_ms;
  return timings;
}

Json
hypothesesOf(const Result& result)
{
  Json list = Json::array();
  for (const Hypothesis& hypothesis : result.hypotheses)
    list.push_back(program::hypothesisOf(hypothesis));
  return list;
}

Json
seenFrom(const Scan& scan)
{
  const char* const sources[] = {"unknown", "stated", "points"};
  Json json = {{"known_by", sources[static_cast<int>(scan.viewpointSource())]}};
  if (scan.viewpoint())
    json["place"] = rowsOf(scan.viewpoint()->transpose())[0];
  return json;
}

Json
leftOut(const LeftOutPoints& points)
{
  return {{"repeated", points.repeated}, {"stray", points.stray}};
}

Json
parametersOf(const Parameters& parameters)
{
  Json json = {{"length_tolerance", parameters.length_tolerance},
               {"min_length_sum", parameters.min_length_sum},
               {"inlier_distance", parameters.inlier_distance},
               {"max_correspondences", parameters.max_correspondences},
               {"min_confidence", parameters.min_confidence},
               {"motion", program::nameOf(parameters.motion)}};
  if (parameters.motion == MotionModel::Upright) {
    json["max_tilt"] = parameters.max_tilt;
    json["source_gravity"] = parameters.source_gravity;
    json["target_gravity"] = parameters.target_gravity;
  }
  return json;
}

} // namespace

std::string
formatJson(const Options& options, const Outcome& outcome)
{
  const Result& result = outcome.pair.pose;
  Json json;
  json["version"] = version();
  json["source"] = options.source;
  json["target"] = options.target;
  json["converged"] = result.converged;
  json["confidence"] = result.confidence;
  json["status"] = program::nameOf(result.status);
  json["transformation"] = rowsOf(result.T_target_source.toMatrix<double>());
  json["inliers"] = result.inliers.size();
  json["correspondences"] = outcome.pair.correspondences;
  json["correspondences_dropped"] = result.correspondences_dropped;
  json["correspondences_invalid"] = result.correspondences_invalid;
  json["score"] = result.score;
  json["distinctness"] = result.distinctness;
  json["evidence"] = program::evidenceOf(result.evidence);
  json["resolution"] =
      outcome.pair.resolution != 0 ? Json(outcome.pair.resolution) : Json();
  json["seen_from"] = {{"source", seenFrom(outcome.pair.source)},
                       {"target", seenFrom(outcome.pair.target)}};
  json["points_left_out"] = {{"source", leftOut(outcome.pair.source_left_out)},
                             {"target", leftOut(outcome.pair.target_left_out)}};
  json["parameters"] = parametersOf(outcome.pair.parameters);
  json["backend"] = result.backend;
  json["second_order"] =
      result.second_order == SecondOrder::Exact ? "exact" : "bounded";
  json["hypotheses"] = hypothesesOf(result);
  json["free_motions"] = program::freeMotionsOf(result.free_motions);
  json["information"] = rowsOf(result.information);
  json["timings_ms"] = timingsOf(outcome);
  return program::textOf(json);
}

} // namespace pcl_flashreg::align
