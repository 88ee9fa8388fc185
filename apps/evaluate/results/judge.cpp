// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judge.h"

namespace pcl_flashreg::evaluate {

double
inlierRatio(const Correspondences& correspondences,
            const RigidTransform& T,
            double inlier_distance)
{
  std::size_t inliers = 0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3d> s(&correspondences.source[3 * i]);
    const Eigen::Map<const Eigen::Vector3d> t(&correspondences.target[3 * i]);
    inliers += (T.rotation * s + T.translation - t).norm() < inlier_distance;
  }
  return correspondences.size() == 0 ? 0
                                     : static_cast<double>(inliers) /
                                           static_cast<double>(correspondences.size());
}

void
judge(const Answer& answer,
      const RigidTransform& truth,
      const Criterion& criterion,
      Record& record)
{
  constexpr double DEGREES = 180 / 3.14159265358979323846;
  const RigidTransform& found = answer.T_target_source;
  record.found = answer.found;
  record.trusted = answer.trusted;
  record.confidence = answer.confidence;
  record.inliers = answer.inliers;
  record.evidence = answer.evidence;
  record.rotation_error =
      DEGREES * Eigen::AngleAxisd(found.rotation.transpose() * truth.rotation).angle();
  record.translation_error = (found.translation - truth.translation).norm();
  record.success = answer.found && record.rotation_error < criterion.max_rotation &&
                   record.translation_error < criterion.max_translation;
  record.times.estimation = answer.estimation_ms;
  record.times.stages = answer.stages_ms;
}

} // namespace pcl_flashreg::evaluate
