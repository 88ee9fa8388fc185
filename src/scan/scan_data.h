// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/array.h"

#include <pcl_flashreg/scan.h>

#include <cstdint>

namespace pcl_flashreg {

/** \brief What Scan's functions of the same names hand out; arrays have a row a keypoint,
 * or none. */
struct Scan::Data {
  Array<float> points;
  Array<float> normals;
  Array<float> curvatures;
  Array<float> descriptors;
  /** \brief Values in a descriptor; 0 where there are none. */
  std::size_t dimension = 0;
  Array<std::int32_t> origins;
  /** \brief See Scan::normalsOriented(). */
  bool normals_oriented = false;
  double spacing = 0;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  std::size_t
  size() const
  {
    return points.size() / 3;
  }
};

} // namespace pcl_flashreg
