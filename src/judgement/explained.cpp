// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/explained.h"

#include "judgement/evidence.h"
#include "math/weighted_alignment.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace pcl_flashreg {

/** \brief Every reflection is a motion of the source's points turned over about the
 * origin. */
Explained
refined(const Problem& problem,
        const Pose& start,
        const Isometries& among,
        int rounds,
        float inlier_distance)
{
  const double sign = among.mirrored ? -1.0 : 1.0;
  Explained best{start, inliersOf(problem, start, inlier_distance)};
  for (int round = 0; round < rounds; ++round) {
    AlignmentSums sums;
    for (const int row : best.rows) {
      const auto i = static_cast<std::size_t>(row);
      const Vec3 d = (1.0 / inlier_distance) *
                     (transform(best.pose, problem.source(i)) - problem.target(i));
      sums.add(1 / (1 + dot(d, d)), sign * problem.source(i), problem.target(i));
    }
    Pose next;
    if (!alignWeighted(sums, among.upright, next))
      break;
    for (double& entry : next.r)
      entry = sign * entry;
    std::vector<int> rows = inliersOf(problem, next, inlier_distance);
    if (rows.size() <= best.rows.size())
      break;
    best = {next, std::move(rows)};
  }
  return best;
}

std::vector<int>
without(const std::vector<int>& rows, const std::vector<int>& others)
{
  std::vector<int> left;
  std::set_difference(
      rows.begin(), rows.end(), others.begin(), others.end(), std::back_inserter(left));
  return left;
}

double
leadOf(std::size_t one, std::size_t other)
{
  const auto a = static_cast<double>(one), b = static_cast<double>(other);
  return (a - b) / std::sqrt(std::max(1.0, a + b));
}

} // namespace pcl_flashreg
