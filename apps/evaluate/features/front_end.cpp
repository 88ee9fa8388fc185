// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "front_end.h"

#include "hash.h"

#include <pcl_flashreg/fpfh_features.h>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief A wavy sheet and a wall: 2000 points with edges, bends and flat parts. */
pcl::PointCloud<pcl::PointXYZ>
madeCloud()
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 25; ++j) {
      const float x = 0.03f * static_cast<float>(i), y = 0.04f * static_cast<float>(j);
      cloud.emplace_back(x, y, 2.0f + 0.25f * x * (x - 1.0f) + 0.125f * y * y);
      cloud.emplace_back(x, 1.0f, 2.0f + y);
    }
  return cloud;
}

} // namespace

std::string
frontEndFingerprint()
{
  const FpfhCloud keypoints = computeFpfh(madeCloud(), {}, 0.1, 1);
  std::string bytes;
  const auto append = [&bytes](const float* values, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(float));
  };
  for (std::size_t i = 0; i < keypoints.points->size(); ++i) {
    append((*keypoints.points)[i].data, 3);
    append((*keypoints.features)[i].histogram, 33);
  }
  return toHex(hashOf(bytes));
}

} // namespace pcl_flashreg::evaluate
