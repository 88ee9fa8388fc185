// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/pose.h"

#include <Eigen/Geometry>

namespace pcl_flashreg {

inline Eigen::Vector3d
toEigen(const Vec3& v)
{
  return {v.x, v.y, v.z};
}

inline Pose
toPose(const Eigen::Isometry3d& T)
{
  Pose pose;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(pose.r) = T.linear();
  Eigen::Map<Eigen::Vector3d>(pose.t) = T.translation();
  return pose;
}

inline Eigen::Isometry3d
toIsometry(const Pose& T)
{
  Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
  isometry.linear() =
      Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(T.r);
  isometry.translation() = Eigen::Map<const Eigen::Vector3d>(T.t);
  return isometry;
}

/** \brief Its product with another vector is v x that vector. */
inline Eigen::Matrix3d
crossMatrix(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

} // namespace pcl_flashreg
