// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/pose.h"

namespace pcl_flashreg {

/** \brief Hypotheses that are refined to fill the list, for every one that is wanted: a
 * bound on the time where many of them turn out to be the same after refinement. */
constexpr unsigned REFINEMENTS_A_HYPOTHESIS = 2;

/** \brief Distinct poses take some point of the data further apart than this many inlier
 * distances. */
constexpr double DISTINCT_DISTANCES = 5;

/** \brief Corners of the cube around the source points. */
constexpr int CORNERS = 8;

/** \brief Whether two poses put a corner to nearly the same place: they are the same if
 * they do so with all of them.
 * \param[in] radius of the source points around the origin
 * \param[in] corner in [0, CORNERS)
 */
PCL_FLASHREG_HD inline bool
agreeOnCorner(
    const Pose& a, const Pose& b, float radius, float inlier_distance, int corner)
{
  const double reach = radius / sqrt(3.0);
  const double limit = DISTINCT_DISTANCES * inlier_distance;
  const Vec3 p{(corner & 1) != 0 ? reach : -reach,
               (corner & 2) != 0 ? reach : -reach,
               (corner & 4) != 0 ? reach : -reach};
  const Vec3 d = transform(a, p) - transform(b, p);
  return dot(d, d) <= limit * limit;
}

/** \brief Whether two poses are the same: they agree on all corners. */
PCL_FLASHREG_HD inline bool
samePose(const Pose& a, const Pose& b, float radius, float inlier_distance)
{
  for (int corner = 0; corner < CORNERS; ++corner)
    if (!agreeOnCorner(a, b, radius, inlier_distance, corner))
      return false;
  return true;
}

} // namespace pcl_flashreg
