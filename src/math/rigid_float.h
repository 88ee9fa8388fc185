// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/pose.h"

#include <Eigen/Core>

namespace pcl_flashreg {

/** \brief A pose for many points in single precision. */
struct RigidFloat {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;

  Eigen::Vector3f
  operator*(const Eigen::Vector3f& point) const
  {
    return rotation * point + translation;
  }
};

inline RigidFloat
toRigidFloat(const Pose& pose)
{
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(pose.r);
  return {rotation.cast<float>(),
          Eigen::Map<const Eigen::Vector3d>(pose.t).cast<float>()};
}

inline RigidFloat
inverse(const RigidFloat& pose)
{
  return {pose.rotation.transpose(), -(pose.rotation.transpose() * pose.translation)};
}

} // namespace pcl_flashreg
