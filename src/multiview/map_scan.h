// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/isometry.h"

#include <pcl_flashreg/result.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief What the map always knows of a scan. Poses within the map are of the scan's middle,
 * so that they are turns of the scan and places of its middle. */
struct MapScan {
  /** \brief Of its surface. */
  std::size_t points = 0;
  /** \brief The middle, in the frame of the scan. */
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  /** \brief Of a sphere about the middle that holds all points. */
  double radius = 0;
  double spacing = 0;
};

/** \brief A pose of each scan's middle, in the frame of its group. */
using MapPoses = std::vector<Eigen::Isometry3d>;

/** \brief Between middles, from a pose between frames. */
Eigen::Isometry3d
betweenMiddles(const RigidTransform& T_target_source,
               const MapScan& target,
               const MapScan& source);

/** \brief The reverse. */
RigidTransform
betweenFrames(const Eigen::Isometry3d& T_target_source,
              const MapScan& target,
              const MapScan& source);

/** \brief Whether two poses of a scan are the same but for noise and drift. */
bool
samePlace(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double spacing);

} // namespace pcl_flashreg
