// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>

#include <Eigen/Core>

namespace pcl_flashreg::evaluate {

/** \brief Keypoints of a cloud with their features. */
struct DescribedCloud {
  FpfhCloud keypoints;
  /** \brief What to add to the keypoints to get coordinates of the file. */
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  /** \brief Where the sensor stood, in the coordinates of the file: a PCD file's VIEWPOINT,
   * else the origin. Not a number where the cloud lies so far from the origin that no
   * sensor can have stood there, which is what a file without one says. */
  Eigen::Vector3d viewpoint = Eigen::Vector3d::Zero();
  /** \brief Milliseconds that it took to compute all this from the points. */
  double features_ms = 0;
};

} // namespace pcl_flashreg::evaluate
