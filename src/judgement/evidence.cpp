// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/evidence.h"

#include "estimation/cpu/residual_test.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace pcl_flashreg {
namespace {

Eigen::Vector3d
sourceOf(const Problem& problem, int row)
{
  const Vec3 point = problem.source(static_cast<std::size_t>(row));
  return {point.x, point.y, point.z};
}

/** \brief Standard deviations of the rows' source points along their principal axes,
 * ascending. */
Eigen::Vector3d
spreadOf(const Problem& problem, const std::vector<int>& rows)
{
  if (rows.empty())
    return Eigen::Vector3d::Zero();
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
  return solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
}

/** \brief Share of all pairs of a source and a target point that are inliers of the pose:
 * the chance that one is which is paired at random. From some of the sources. */
double
shareOfAllPairs(const Problem& problem,
                const Pose& pose,
                float inlier_distance,
                ThreadPool& pool)
{
  constexpr std::size_t SOURCES = 128, SOURCES_A_TASK = 8;
  const std::size_t looked_at = std::min(SOURCES, problem.size);
  const cpu::ResidualTest test(cpu::usualKernels(), problem, inlier_distance);
  std::array<std::size_t, SOURCES / SOURCES_A_TASK> near{};
  pool.forEach(near.size(), [&](std::size_t task, std::size_t) {
    const std::size_t begin = task * SOURCES_A_TASK;
    for (std::size_t k = begin; k < std::min(looked_at, begin + SOURCES_A_TASK); ++k) {
      const Vec3 moved = transform(pose, problem.source(k * problem.size / looked_at));
      // A motion that takes every source there has all targets near it for inliers.
      const PoseF there{{},
                        {static_cast<float>(moved.x),
                         static_cast<float>(moved.y),
                         static_cast<float>(moved.z)}};
      near[task] += static_cast<std::size_t>(test.count(there));
    }
  });
  return static_cast<double>(
             std::accumulate(near.begin(), near.end(), std::size_t{0})) /
         (static_cast<double>(looked_at) * static_cast<double>(problem.size));
}

/** \brief Poses that differ in their inliers: steps of half the inlier distance in three
 * directions, and of what moves the farthest point as much in three turns. Upright ones turn
 * about two axes only as far as they may tilt. */
double
logOfPoses(const Problem& problem, float inlier_distance)
{
  constexpr double STEPS = 2, MOTIONS = 6, TILTS = 2;
  const double steps = STEPS * 2 * problem.radius / inlier_distance;
  const double of_one = std::log(std::max(1.0, steps));
  if (!problem.upright.required)
    return MOTIONS * of_one;
  return (MOTIONS - TILTS) * of_one +
         TILTS * std::log(std::max(1.0, steps * problem.upright.sine));
}

/** \brief Bound on the logarithm of the chance of that many hits in so many draws (Chernoff,
 * Hoeffding). */
double
logOfTail(double hits, double draws, double share)
{
  const double found = hits / draws;
  if (found <= share)
    return 0;
  double divergence = found * std::log(found / share);
  if (found < 1)
    divergence += (1 - found) * std::log((1 - found) / (1 - share));
  return -draws * divergence;
}

} // namespace

std::vector<int>
inliersOf(const Problem& problem, const Pose& pose, float inlier_distance)
{
  return cpu::ResidualTest(cpu::usualKernels(), problem, inlier_distance)
      .rows(toSingle(pose));
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
                   const Pose& pose,
                   const std::vector<int>& inliers,
                   int rival_inliers,
                   float inlier_distance,
                   ThreadPool& pool,
                   Evidence& evidence)
{
  evidence.inliers = static_cast<double>(inliers.size());
  evidence.inlier_ratio = evidence.inliers / static_cast<double>(problem.size);
  evidence.rival_inliers = rival_inliers;
  const Eigen::Vector3d spread = spreadOf(problem, inliers) / (0.5 * inlier_distance);
  evidence.thickness = spread[0];
  evidence.breadth = spread[1];
  const auto draws = static_cast<double>(problem.size);
  const double share = std::max(shareOfAllPairs(problem, pose, inlier_distance, pool),
                                1 / (draws * draws));
  evidence.log_chance =
      logOfPoses(problem, inlier_distance) + logOfTail(evidence.inliers, draws, share);
}

} // namespace pcl_flashreg
