// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Made points as files have them, for tests of programs that read scans.

#include "io/cloud_io.h"
#include "support/made_correspondences.h"

#include <vector>

namespace pcl_flashreg {

inline io::Cloud
cloudOf(const std::vector<Eigen::Vector3d>& points)
{
  io::Cloud cloud;
  for (const char* name : {"x", "y", "z", "intensity"})
    cloud.addField(name, io::ScalarType::Float32);
  cloud.width = points.size();
  cloud.data.resize(cloud.size() * cloud.point_size);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      io::storeValue(cloud.point(i),
                     cloud.fields[axis],
                     points[i][static_cast<Eigen::Index>(axis)]);
    io::storeValue(cloud.point(i), cloud.fields[3], static_cast<double>(i % 100));
  }
  return cloud;
}

/** \brief What fits nothing. */
inline std::vector<Eigen::Vector3d>
blobPoints()
{
  made::Random random(5);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(random.normal(), random.normal(), random.normal());
  return points;
}

} // namespace pcl_flashreg
