// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/mirror.h"

#include "estimation/cpu/residual_test.h"
#include "estimation/part.h"
#include "judgement/evidence.h"
#include "judgement/explained.h"
#include "math/symmetric3.h"
#include "math/triplet_alignment.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Correspondences that are asked about each clique's reflection at most, spread evenly
 * over their numbers. */
constexpr std::size_t ASKED = 2048;
/** \brief Reflections that are refined, and rounds of it. */
constexpr std::size_t REFINED = 3;
constexpr int ROUNDS = 5;

struct Plane {
  /** \brief Of length 1. */
  Vec3 normal;
  Vec3 point;
};

/** \brief The pose after the source was turned over about a plane. */
Pose
afterReflection(const Pose& T, const Plane& plane)
{
  const Vec3 turned = rotate(T.r, plane.normal);
  const double normal[3] = {plane.normal.x, plane.normal.y, plane.normal.z};
  const double image[3] = {turned.x, turned.y, turned.z};
  const double offset = 2 * dot(plane.normal, plane.point);
  Pose result;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      result.r[3 * i + j] = T.r[3 * i + j] - 2 * image[i] * normal[j];
    result.t[i] = T.t[i] + offset * image[i];
  }
  return result;
}

/** \return false if the clique is degenerate */
bool
reflectionOf(const Problem& problem, const Clique& clique, Pose& reflection)
{
  const Vec3 s[3] = {
      problem.source(clique.u), problem.source(clique.v), problem.source(clique.w)};
  const Vec3 t[3] = {
      problem.target(clique.u), problem.target(clique.v), problem.target(clique.w)};
  Pose T;
  if (!alignTriplet(s, t, T))
    return false;
  const Vec3 across = cross(s[1] - s[0], s[2] - s[0]);
  reflection =
      afterReflection(T, {(1 / std::sqrt(dot(across, across))) * across, s[0]});
  return true;
}

/** \brief The reflection that explains most; none where all cliques are degenerate. */
Explained
bestReflection(const Problem& problem,
               const std::vector<Clique>& cliques,
               float inlier_distance,
               ThreadPool& pool)
{
  std::vector<std::size_t> all(problem.size);
  std::iota(all.begin(), all.end(), std::size_t{0});
  Problem asked;
  takeRows(problem, all, ASKED, asked);
  const cpu::ResidualTest test(cpu::usualKernels(), asked, inlier_distance);
  std::vector<Pose> reflections(cliques.size());
  std::vector<std::pair<int, std::size_t>> ranked(cliques.size());
  pool.forEach(cliques.size(), [&](std::size_t c, std::size_t) {
    const bool valid = reflectionOf(problem, cliques[c], reflections[c]);
    const int agreeing = valid ? test.count(toSingle(reflections[c])) : 0;
    ranked[c] = {-agreeing, c};
  });
  std::sort(ranked.begin(), ranked.end());
  Explained best{};
  for (std::size_t k = 0; k < std::min(REFINED, ranked.size()); ++k) {
    if (ranked[k].first == 0)
      break;
    Explained found = refined(problem,
                              reflections[ranked[k].second],
                              {/* mirrored */ true, {}},
                              ROUNDS,
                              inlier_distance);
    if (found.rows.size() > best.rows.size())
      best = std::move(found);
  }
  return best;
}

/** \brief The plane that most of the rows' source points lie near. */
Plane
planeThrough(const Problem& problem, std::vector<int> rows, float reach)
{
  Plane plane{{0, 0, 1}, {0, 0, 0}};
  for (int round = 0; round < ROUNDS && rows.size() >= 3; ++round) {
    const double share = 1 / static_cast<double>(rows.size());
    Vec3 mean{0, 0, 0};
    for (const int row : rows)
      mean = mean + share * problem.source(static_cast<std::size_t>(row));
    Symmetric3 spread{0, 0, 0, 0, 0, 0};
    for (const int row : rows) {
      const Vec3 d = problem.source(static_cast<std::size_t>(row)) - mean;
      spread.xx += d.x * d.x;
      spread.xy += d.x * d.y;
      spread.xz += d.x * d.z;
      spread.yy += d.y * d.y;
      spread.yz += d.y * d.z;
      spread.zz += d.z * d.z;
    }
    plane.point = mean;
    if (!smallestEigenvector(spread, smallestEigenvalue(spread), plane.normal))
      break;
    const auto far = [&](int row) {
      const Vec3 d = problem.source(static_cast<std::size_t>(row)) - mean;
      return !(std::abs(dot(plane.normal, d)) < reach);
    };
    rows.erase(std::remove_if(rows.begin(), rows.end(), far), rows.end());
  }
  return plane;
}

} // namespace

double
mirroredEvidence(const Problem& problem,
                 const std::vector<Clique>& cliques,
                 const std::vector<Pose>& motions,
                 float inlier_distance,
                 ThreadPool& pool)
{
  const Explained mirrored = bestReflection(problem, cliques, inlier_distance, pool);
  // What lies in one plane, a motion explains as well.
  const Pose turned = afterReflection(
      mirrored.pose, planeThrough(problem, mirrored.rows, inlier_distance));
  std::vector<int> alone =
      without(mirrored.rows, inliersOf(problem, turned, inlier_distance));
  std::size_t others = 0;
  for (const Pose& motion : motions) {
    const std::vector<int> rows = inliersOf(problem, motion, inlier_distance);
    alone = without(alone, rows);
    others = std::max(others, without(rows, mirrored.rows).size());
  }
  return leadOf(alone.size(), others);
}

} // namespace pcl_flashreg
