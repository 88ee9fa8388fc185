// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_sensor.h"

#include <pcl_flashreg/result.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief The hall from six places, each scan in a frame of its own, whose origin is the
 * sensor. */
struct HallScans {
  static constexpr double RESOLUTION = 0.1;

  std::vector<std::vector<Eigen::Vector3d>> scans;
  std::vector<Eigen::Isometry3d> T_hall_scan;

  /** \param[in] level whether the sensors stand upright; else they are turned anyhow */
  explicit HallScans(bool level = true, int rays = 20000)
  {
    const Eigen::Vector3d places[] = {{2, 1.5, 1.5},
                                      {3, 2.5, 1.6},
                                      {4.2, 3.5, 1.4},
                                      {5.5, 2.2, 1.5},
                                      {6.3, 4, 1.6},
                                      {2.5, 4.3, 1.5}};
    Random random(5);
    for (const Eigen::Vector3d& place : places) {
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.rotate(Eigen::AngleAxisd(random.uniform(-3, 3), Eigen::Vector3d::UnitZ()));
      if (!level)
        pose.rotate(
            Eigen::AngleAxisd(random.uniform(-3, 3), random.inCube(1).normalized()));
      pose.pretranslate(place);
      scans.emplace_back();
      for (const auto& point : Hall::seenFrom(place, rays, 20 + scans.size()))
        scans.back().push_back(pose.inverse() * point);
      T_hall_scan.push_back(pose);
    }
  }

  /** \brief How far a pose between two scans is off where the source is, in metres. */
  double
  error(const Eigen::Isometry3d& T_target_source,
        std::size_t target,
        std::size_t source) const
  {
    const Eigen::Vector3d far(3, 3, 1);
    const Eigen::Isometry3d truth = T_hall_scan[target].inverse() * T_hall_scan[source];
    return (T_target_source * far - truth * far).norm();
  }

  /** \brief A pose that is known, as results have it. */
  RigidTransform
  pose(std::size_t target, std::size_t source) const
  {
    const Eigen::Isometry3d truth = T_hall_scan[target].inverse() * T_hall_scan[source];
    return {truth.rotation(), truth.translation()};
  }
};

} // namespace made
} // namespace pcl_flashreg
