// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <pcl/common/transforms.h>
#include <pcl/point_cloud.h>
#include <pcl/type_traits.h>

namespace pcl_flashreg {
namespace detail {

/** \brief Moves the points of a cloud, with their normals, and its sensor's pose. In double
 * precision: coordinates may be large. */
template <typename PointT>
void
moveCloud(pcl::PointCloud<PointT>& cloud, const RigidTransform& T_new_old)
{
  const Eigen::Matrix4d matrix = T_new_old.toMatrix<double>();
  if constexpr (pcl::traits::has_normal<PointT>::value)
    pcl::transformPointCloudWithNormals(cloud, cloud, matrix);
  else
    pcl::transformPointCloud(cloud, cloud, matrix);
  const Eigen::Vector3d origin =
      cloud.sensor_origin_.template head<3>().template cast<double>();
  const Eigen::Quaterniond orientation =
      cloud.sensor_orientation_.template cast<double>();
  cloud.sensor_origin_.template head<3>() =
      (T_new_old.rotation * origin + T_new_old.translation).template cast<float>();
  cloud.sensor_orientation_ =
      (Eigen::Quaterniond(T_new_old.rotation) * orientation).template cast<float>();
}

} // namespace detail
} // namespace pcl_flashreg
