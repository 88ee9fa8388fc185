// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/map_scan.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief Poses of a scan are the same up to this angle (10 degrees), and if its middle moves
 * by no more than so many spacings: fragments bend. */
constexpr double SAME_ANGLE = 0.1745, SAME_WAY = 6;

Eigen::Vector3d
middleOf(const Scan& scan)
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Vector3d point =
        Eigen::Map<const Eigen::Vector3f>(scan.points() + 3 * i).cast<double>();
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return scan.empty() ? Eigen::Vector3d::Zero().eval() : (0.5 * (low + high)).eval();
}

} // namespace

MapScan::MapScan(const Scan& scan) : spacing(scan.spacing())
{
  const Eigen::Vector3d origin = middleOf(scan);
  middle = origin + scan.shift();
  CloudView<float> view{scan.points(), scan.normals(), scan.size(), std::nullopt};
  if (scan.viewpoint())
    view.viewpoint = *scan.viewpoint() - scan.shift();
  surface.build(
      view, {origin.x(), origin.y(), origin.z()}, static_cast<float>(spacing));
  for (const Eigen::Vector3f& point : surface.points)
    radius = std::max(radius, static_cast<double>(point.norm()));
}

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

SurfacePair
cloudsOf(const MapScan& source, const MapScan& target)
{
  return {source.surface,
          target.surface,
          static_cast<float>(std::max(source.spacing, target.spacing))};
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
