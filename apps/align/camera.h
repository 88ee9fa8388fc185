// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

namespace pcl_flashreg::align {

/** \brief Which way a viewer looks, in the frame of the points. */
struct ViewDirection {
  /** \brief Unit vector from what is looked at to the viewer. */
  Eigen::Vector3d toward_viewer;
  /** \brief Unit vector across, to the right in the picture. */
  Eigen::Vector3d right;
  /** \brief Unit vector, upwards in the picture. */
  Eigen::Vector3d up;
};

/** \brief A direction from which there is much to see.
 *
 * Points that a depth camera at the origin sees (z forward, y down) are looked at from
 * beside that camera; others from obliquely above the plane in which they spread most.
 * \param[in] xyz finite points, a column each, in the frame in which they were taken
 */
ViewDirection
chooseViewDirection(const Eigen::Matrix3Xd& xyz);

/** \brief A pinhole camera for a square picture. */
class Camera {
public:
  /** \brief As near as it can be with nearly all of the points in the picture. */
  Camera(const ViewDirection& direction, const Eigen::Matrix3Xd& xyz);

  /** \brief Where a point appears: x to the right and y upwards, both -1 to 1 within
   * the picture, then the distance from the viewer along the line of sight (what is not
   * > 0 is behind the viewer). */
  Eigen::Vector3d
  project(const Eigen::Vector3d& point) const;

  /** \brief Distance of the viewer from the middle of the points. */
  double
  distance() const
  {
    return distance_;
  }

private:
  Eigen::Matrix3d R_view_world_;
  /** \brief What the viewer looks at. */
  Eigen::Vector3d centre_;
  double distance_ = 1;
};

} // namespace pcl_flashreg::align
