// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "../io/pose_io.h"
#include "../program/pair_json.h"
#include "report.h"

namespace pcl_flashreg::localize {
namespace {

using program::Json, program::rowsOf;

/** \brief The matrix, and the same as files of poses have it. */
void
addPose(Json& json, const RigidTransform& pose)
{
  const Eigen::Quaterniond q = io::quaternionOf(pose);
  json["transformation"] = rowsOf(pose.toMatrix<double>());
  json["translation"] = rowsOf(pose.translation.transpose())[0];
  json["quaternion"] = {q.x(), q.y(), q.z(), q.w()};
}

Json
rivalJson(const Hypothesis& rival)
{
  Json json;
  addPose(json, rival.T_target_source);
  json.update(program::hypothesisOf(rival));
  json["matched"] = rival.agreement->matched;
  json["contradicted"] = rival.agreement->contradicted;
  json["residual"] = rival.agreement->residual;
  return json;
}

void
addResult(Json& json, const Located& located)
{
  const Result& result = located.result;
  json["status"] = program::nameOf(result.status);
  if (located.hasPose())
    addPose(json, located.T_map_scan());
  json["inliers"] = result.inliers.size();
  json["correspondences"] = located.correspondences;
  json["keypoints"] = located.keypoints;
  json["evidence"] = program::evidenceOf(result.evidence);
  json["rivals"] = Json::array();
  for (const Hypothesis& rival : rivalsOf(result))
    json["rivals"].push_back(rivalJson(rival));
  json["free_motions"] = program::freeMotionsOf(result);
  json["information"] = rowsOf(result.information);
}

} // namespace

Json
jsonOf(const Located& located)
{
  Json json;
  json["file"] = located.file.path;
  json["converged"] = located.isTrusted();
  json["confidence"] = located.result.confidence;
  if (located.error.empty())
    addResult(json, located);
  else
    json["error"] = located.error;
  json["warnings"] = located.warnings;
  json["timings_ms"] = {{"reading", located.times.reading},
                        {"scan", located.times.scan},
                        {"placing", located.times.placing},
                        {"total", located.times.total}};
  return json;
}

} // namespace pcl_flashreg::localize
