// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/map_scan.h"

#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief Poses of a scan are the same up to this angle (10 degrees), and if its middle moves
 * by no more than so many spacings: fragments bend. */
constexpr double SAME_ANGLE = 0.1745, SAME_WAY = 6;

} // namespace

Eigen::Isometry3d
betweenMiddles(const RigidTransform& T, const MapScan& target, const MapScan& source)
{
  Eigen::Isometry3d result = T.toIsometry();
  result.translation() += T.rotation * source.middle - target.middle;
  return result;
}

RigidTransform
betweenFrames(const Eigen::Isometry3d& T, const MapScan& target, const MapScan& source)
{
  RigidTransform result;
  result.rotation = T.linear();
  result.translation = T.translation() + target.middle - T.linear() * source.middle;
  return result;
}

bool
samePlace(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double spacing)
{
  // The trace tells the angle without a root.
  const double trace = (a.linear().transpose() * b.linear()).trace();
  return (a.translation() - b.translation()).norm() < SAME_WAY * spacing &&
         trace > 1 + 2 * std::cos(SAME_ANGLE);
}

} // namespace pcl_flashreg
