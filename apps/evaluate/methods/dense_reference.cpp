// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// TurboReg's formulation as its authors state it, for a CPU: dense matrices of N x N, the
// best edges of the whole matrix, rows scanned for third corners. A baseline and an oracle:
// stages 1 to 4 are those that the unit tests compare the library with, and no code is
// shared with the library. Rows are spread over threads.

#include "families.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include "support/reference.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <thread>

namespace pcl_flashreg::evaluate {
namespace {

using Points = Eigen::Matrix3Xd;

/** \brief The rows that are used, centred. */
struct Centred {
  Points source, target;
  Eigen::Vector3d source_centre, target_centre;
};

/** \brief The best-ranked rows, all finite, in the order of the input. */
std::vector<Eigen::Index>
usedRows(const Correspondences& given, std::size_t limit)
{
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto isFinite = [](double x) { return std::isfinite(x); };
    if (std::all_of(&given.source[3 * i], &given.source[3 * i] + 3, isFinite) &&
        std::all_of(&given.target[3 * i], &given.target[3 * i] + 3, isFinite))
      rows.push_back(static_cast<Eigen::Index>(i));
  }
  if (!given.ranks.empty())
    std::stable_sort(rows.begin(), rows.end(), [&](Eigen::Index a, Eigen::Index b) {
      return given.ranks[static_cast<std::size_t>(a)] <
             given.ranks[static_cast<std::size_t>(b)];
    });
  rows.resize(std::min(rows.size(), limit));
  std::sort(rows.begin(), rows.end());
  return rows;
}

Centred
centre(const Correspondences& given, std::size_t limit)
{
  const auto rows = usedRows(given, limit);
  const auto n = static_cast<Eigen::Index>(rows.size());
  Centred points{Points(3, n), Points(3, n), {}, {}};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto row = static_cast<std::size_t>(rows[static_cast<std::size_t>(i)]);
    points.source.col(i) = Eigen::Map<const Eigen::Vector3d>(&given.source[3 * row]);
    points.target.col(i) = Eigen::Map<const Eigen::Vector3d>(&given.target[3 * row]);
  }
  points.source_centre = points.source.rowwise().mean();
  points.target_centre = points.target.rowwise().mean();
  points.source.colwise() -= points.source_centre;
  points.target.colwise() -= points.target_centre;
  return points;
}

std::vector<float>
toSingle(const Points& points)
{
  return {points.data(), points.data() + points.size()};
}

/** \brief Whether three points are a triangle that fixes a rotation: its sides enclose
 * 0.6 degrees at least. */
bool
isTriangle(const Points& points, const reference::Triple& c)
{
  const auto at = [&](std::size_t i) -> Eigen::Vector3d {
    return points.col(static_cast<Eigen::Index>(i));
  };
  const Eigen::Vector3d a = at(c.v) - at(c.u), b = at(c.w) - at(c.u);
  return a.cross(b).norm() > 0.01 * a.norm() * b.norm();
}

/** \brief Weighted least squares (Kabsch, by a singular value decomposition). */
Eigen::Isometry3d
align(const Points& source, const Points& target, const Eigen::VectorXd& weights)
{
  const double sum = weights.sum();
  const Eigen::Vector3d s = source * weights / sum, t = target * weights / sum;
  const Eigen::Matrix3d H = (source.colwise() - s) * weights.asDiagonal() *
                            (target.colwise() - t).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(
      1, 1, (svd.matrixV() * svd.matrixU().transpose()).determinant());
  Eigen::Isometry3d T;
  T.linear() = svd.matrixV() * signs.asDiagonal() * svd.matrixU().transpose();
  T.translation() = t - T.linear() * s;
  return T;
}

Eigen::Isometry3d
alignTriple(const Centred& points, const reference::Triple& c)
{
  Points source(3, 3), target(3, 3);
  Eigen::Index column = 0;
  for (const std::size_t i : {c.u, c.v, c.w}) {
    source.col(column) = points.source.col(static_cast<Eigen::Index>(i));
    target.col(column++) = points.target.col(static_cast<Eigen::Index>(i));
  }
  return align(source, target, Eigen::Vector3d::Ones());
}

Eigen::ArrayXd
squaredResiduals(const Centred& points, const Eigen::Isometry3d& T)
{
  return ((T.linear() * points.source).colwise() + T.translation() - points.target)
      .colwise()
      .squaredNorm()
      .array();
}

Eigen::Index
countInliers(const Centred& points, const Eigen::Isometry3d& T, double distance)
{
  return (squaredResiduals(points, T) < distance * distance).count();
}

/** \brief The hypothesis with the most inliers, the first of several; false if there is
 * none. */
bool
best(const Centred& points,
     const std::vector<reference::Triple>& cliques,
     double distance,
     unsigned threads,
     Eigen::Isometry3d& T)
{
  std::vector<Eigen::Index> inliers(cliques.size(), -1);
  reference::forRows(cliques.size(), threads, [&](std::size_t i) {
    if (isTriangle(points.source, cliques[i]) && isTriangle(points.target, cliques[i]))
      inliers[i] = countInliers(points, alignTriple(points, cliques[i]), distance);
  });
  const auto most = std::max_element(inliers.begin(), inliers.end());
  if (most == inliers.end() || *most < 0)
    return false;
  T = alignTriple(points, cliques[static_cast<std::size_t>(most - inliers.begin())]);
  return true;
}

/** \brief Rounds of reweighted alignment until the number of inliers stays the same. */
Eigen::Index
refine(const Centred& points, const Parameters& p, Eigen::Isometry3d& T)
{
  const double limit = static_cast<double>(p.inlier_distance) * p.inlier_distance;
  Eigen::Index count = countInliers(points, T, p.inlier_distance);
  for (int round = 0; round < p.refinement_iterations && count >= 3; ++round) {
    const Eigen::ArrayXd squared = squaredResiduals(points, T);
    const Eigen::VectorXd weights =
        (squared < limit).select(1 / (1 + squared / limit), 0.0).matrix();
    T = align(points.source, points.target, weights);
    const Eigen::Index previous = count;
    count = countInliers(points, T, p.inlier_distance);
    if (count == previous)
      break;
  }
  return count;
}

Answer
run(const Parameters& p, unsigned threads, const Correspondences& given)
{
  const detail::Stopwatch estimation;
  Answer answer;
  const Centred points = centre(given, static_cast<std::size_t>(p.max_correspondences));
  const auto graph = reference::firstOrderGraph(toSingle(points.source),
                                                toSingle(points.target),
                                                p.length_tolerance,
                                                p.min_length_sum,
                                                threads);
  const auto scores = reference::exactScores(graph, threads);
  const auto pivots = reference::pivots(scores, static_cast<std::size_t>(p.pivots));
  const auto cliques =
      reference::cliques(scores, pivots, static_cast<std::size_t>(p.cliques_per_pivot));
  Eigen::Isometry3d T;
  if (best(points, cliques, p.inlier_distance, threads, T)) {
    answer.inliers = static_cast<std::size_t>(refine(points, p, T));
    answer.found = answer.inliers >= 3;
    answer.T_target_source = {T.linear(),
                              T.translation() + points.target_centre -
                                  T.linear() * points.source_centre};
  }
  answer.trusted = answer.found;
  answer.confidence = static_cast<double>(answer.inliers);
  answer.estimation_ms = estimation.milliseconds();
  return answer;
}

} // namespace

std::vector<MethodEntry>
denseReferenceMethods()
{
  return {{"dense_reference",
           "TurboReg's formulation on dense matrices, on the CPU",
           false,
           [](const MethodSettings& settings) {
             const Parameters parameters = settings.parameters;
             const unsigned threads = settings.threads != 0
                                          ? settings.threads
                                          : std::thread::hardware_concurrency();
             return [=](const Problem& problem) {
               return run(parameters, threads, problem.correspondences);
             };
           }}};
}

} // namespace pcl_flashreg::evaluate
