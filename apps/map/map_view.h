// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/multiview_registration.h>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl_flashreg::map {

/** \brief A scan from above; lengths in the unit of the scans, x to the right and y
 * upwards in the picture. */
struct FlatScan {
  std::size_t scan = 0;
  Eigen::Matrix2Xf points;
  /** \brief Where the sensor stood; the middle of the points, where that is not known, or
   * where a sensor of the group stood far outside of the group. */
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
};

/** \brief A group of scans from above. */
struct FlatGroup {
  std::vector<FlatScan> scans;
  /** \brief Around nearly all points, and all places. */
  Eigen::AlignedBox2d box;
  /** \brief Distance of neighbouring points of a scan; the coarsest. */
  double spacing = 0;
  /** \brief A point of the group's frame lies at view * (point - origin). */
  Eigen::Matrix<double, 2, 3> view = Eigen::Matrix<double, 2, 3>::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  /** \brief How many points of a scan each one that is here stands for, >= 1. */
  double weight = 1;
};

/** \brief The direction, of length 1, that is upwards in a group, from what is known of it.
 *
 * Cameras and laser scanners are held level: if the x axes of the scans are spread about
 * one direction and perpendicular to it, that is upright. Else it is the direction in which
 * the points spread least; the frame's own z, if that is within 30 degrees of it. In any case
 * it is then turned by a few degrees to where most normals are parallel or perpendicular to
 * it: floors are level and walls upright. Up is where most scans have their z axis, or have
 * it against their y axis, whichever is steeper: laser scanners and cameras.
 * \param[in] axes of the scans: R_group_scan
 * \param[in] points in the group's frame, finite
 * \param[in] normals likewise, of any sign
 */
Eigen::Vector3d
upwards(const std::vector<Eigen::Matrix3d>& axes,
        const Eigen::Matrix3Xf& points,
        const Eigen::Matrix3Xf& normals);

/** \brief A group along upwards(), turned so that it lies in the smallest box, which is as
 * wide as high or wider.
 * \param[in] members of the group
 * \param[in] most points that are taken of all scans together, evenly from each */
FlatGroup
seenFromAbove(const std::vector<std::size_t>& members,
              const MultiviewResult& result,
              const MultiviewRegistration::ScanSource& scans,
              std::size_t most = 4000000);

} // namespace pcl_flashreg::map
