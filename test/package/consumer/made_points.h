// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstdint>
#include <vector>

/** \brief A row of pseudo-random numbers in [0, 1). */
class Numbers {
public:
  double
  next()
  {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<double>(state_ >> 11) * 0x1.0p-53;
  }

  Eigen::Vector3d
  nextPoint(double size)
  {
    const double x = size * next();
    const double y = size * next();
    const double z = size * next();
    return {x, y, z};
  }

private:
  std::uint64_t state_ = 1;
};

inline Eigen::Isometry3d
truePose()
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translate(Eigen::Vector3d(1.0, -2.0, 0.5));
  pose.rotate(Eigen::AngleAxisd(0.8, Eigen::Vector3d(1.0, 2.0, 3.0).normalized()));
  return pose;
}
