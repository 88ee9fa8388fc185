// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl_flashreg::io {

/** \brief Points in single precision as PCL wants them, and what to add to get the
 * coordinates of the file again. */
struct ShiftedCloud {
  pcl::PointCloud<pcl::PointXYZ>::Ptr points;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
};

/** \brief Rounds coordinates to single precision, after a shift to the middle of their
 * bounding box where that is so far from the origin (geo-referenced clouds) that
 * rounding would show. Without need there is no shift: PCL takes the origin for the
 * place of the sensor when it turns normals. Points keep their numbers; those with a
 * coordinate that is not finite stay so.
 */
ShiftedCloud
toPclCloud(const Eigen::Matrix3Xd& xyz);

/** \brief Whether single precision is too coarse for these coordinates: its steps there
 * are more than a hundred-thousandth of the extent of the cloud. */
bool
needsDoublePrecision(const Eigen::Matrix3Xd& xyz);

} // namespace pcl_flashreg::io
