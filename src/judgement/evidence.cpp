// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/evidence.h"

#include "math/residual.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

Eigen::Vector3d
sourceOf(const Problem& problem, int row)
{
  const Vec3 point = problem.source(static_cast<std::size_t>(row));
  return {point.x, point.y, point.z};
}

/** \brief Smallest standard deviation of the rows' source points along any axis. */
double
thicknessOf(const Problem& problem, const std::vector<int>& rows)
{
  if (rows.empty())
    return 0;
  const auto count = static_cast<double>(rows.size());
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int row : rows)
    mean += sourceOf(problem, row) / count;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int row : rows) {
    const Eigen::Vector3d offset = sourceOf(problem, row) - mean;
    covariance += offset * offset.transpose() / count;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance,
                                                              Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
}

} // namespace

std::vector<int>
inliersOf(const Problem& problem, const Pose& pose, float inlier_distance)
{
  const PoseF single = toSingle(pose);
  std::vector<int> inliers;
  for (std::size_t i = 0; i < problem.size; ++i)
    if (squaredResidual(single, problem.pair(i)) < inlier_distance * inlier_distance)
      inliers.push_back(static_cast<int>(i));
  return inliers;
}

std::int64_t
scoreOf(const Problem& problem,
        const Pose& pose,
        const std::vector<int>& inliers,
        const Parameters& parameters)
{
  if (parameters.score_metric == ScoreMetric::Inliers)
    return static_cast<std::int64_t>(inliers.size()) * SCORE_UNIT;
  const PoseF single = toSingle(pose);
  const float limit = parameters.inlier_distance;
  std::int64_t score = 0;
  for (const int row : inliers) {
    const float squared =
        squaredResidual(single, problem.pair(static_cast<std::size_t>(row)));
    score += parameters.score_metric == ScoreMetric::Mae ? maeScore(squared, limit)
                                                         : mseScore(squared, limit);
  }
  return score;
}

void
addCorrespondences(const Problem& problem,
                   const std::vector<int>& inliers,
                   int rival_inliers,
                   float inlier_distance,
                   Evidence& evidence)
{
  evidence.inliers = static_cast<double>(inliers.size());
  evidence.inlier_ratio = evidence.inliers / static_cast<double>(problem.size);
  evidence.rival_inliers = rival_inliers;
  evidence.thickness = thicknessOf(problem, inliers) / (0.5 * inlier_distance);
}

} // namespace pcl_flashreg
