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
agreementJson(const CloudAgreement& agreement)
{
  return {{"matched", agreement.matched},
          {"contradicted", agreement.contradicted},
          {"residual", agreement.residual}};
}

Json
rivalJson(const Hypothesis& rival)
{
  Json json;
  addPose(json, rival.T_target_source);
  json.update(program::hypothesisOf(rival));
  json.update(agreementJson(*rival.agreement));
  return json;
}

/** \brief What was found of the scan by itself. */
void
addResult(Json& json, const Located& located)
{
  const Result& result = located.result;
  json["status"] = program::nameOf(result.status);
  if (result.status == Status::Ok)
    addPose(json, result.T_target_source);
  json["inliers"] = result.inliers.size();
  json["correspondences"] = located.correspondences;
  json["keypoints"] = located.keypoints;
  json["evidence"] = program::evidenceOf(result.evidence);
  json["rivals"] = Json::array();
  for (const Hypothesis& rival : rivalsOf(result))
    json["rivals"].push_back(rivalJson(rival));
  json["free_motions"] = program::freeMotionsOf(result.free_motions);
  json["information"] = rowsOf(result.information);
}

void
addInSequence(Json& json, const Located& located)
{
  if (located.hasPose())
    addPose(json, located.T_map_scan());
  json.update(agreementJson(located.in_sequence->agreement));
  Json& alone = json["alone"];
  alone["converged"] = located.result.converged;
  alone["confidence"] = located.result.confidence;
  addResult(alone, located);
}

Json
placementJson(const SequencePlacement& placement)
{
  Json json;
  addPose(json, placement.T_map_sequence);
  json.update(agreementJson(placement.agreement));
  json["inliers"] = placement.inliers;
  json["supporters"] = placement.supporters;
  return json;
}

} // namespace

Json
jsonOf(const LocatedSequence& sequence)
{
  const SequenceResult& result = sequence.result;
  Json json;
  json["sequence"] = sequence.file;
  json["scans"] = sequence.scans;
  json["converged"] = sequence.isTrusted();
  json["confidence"] = result.confidence;
  if (!result.placements.empty())
    json.update(placementJson(result.placements.front()));
  json["evidence"] = program::evidenceOf(result.evidence);
  json["rivals"] = Json::array();
  for (const SequencePlacement* rival : rivalsOf(result))
    json["rivals"].push_back(placementJson(*rival));
  json["free_motions"] = program::freeMotionsOf(result.free_motions);
  json["warnings"] = sequence.warnings;
  json["timings_ms"] = {{"placing", sequence.placing}};
  return json;
}

Json
jsonOf(const Located& located)
{
  Json json;
  json["file"] = located.file.path;
  json["converged"] = located.isTrusted();
  json["confidence"] = located.confidence();
  if (!located.error.empty())
    json["error"] = located.error;
  else if (located.in_sequence)
    addInSequence(json, located);
  else
    addResult(json, located);
  json["warnings"] = located.warnings;
  json["timings_ms"] = {{"reading", located.times.reading},
                        {"scan", located.times.scan},
                        {"placing", located.times.placing},
                        {"total", located.times.total}};
  return json;
}

} // namespace pcl_flashreg::localize
