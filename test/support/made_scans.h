// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_room.h"

#include <pcl_flashreg/scan.h>

#include <Eigen/Geometry>

#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief Two scans of the room, each with a part of it that the other lacks, the source in
 * a frame of its own; the sensor stood at the same place. */
struct RoomScans {
  static constexpr double RESOLUTION = 0.1;

  std::vector<double> source, target;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  Eigen::Vector3d target_viewpoint{1.6, 2.0, 1.8};
  Eigen::Vector3d source_viewpoint;

  explicit RoomScans(std::uint64_t seed = 1, double points_per_square_metre = 400)
  {
    T_target_source.rotate(
        Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.5, 0.9).normalized()));
    T_target_source.pretranslate(Eigen::Vector3d(4, -3, 1.5));
    const Eigen::Isometry3d T_source_target = T_target_source.inverse();
    source_viewpoint = T_source_target * target_viewpoint;
    const Room first(seed, points_per_square_metre, 0.004);
    const Room second(seed + 1000, points_per_square_metre, 0.004);
    for (const auto& p : first.points())
      if (p.x() < 2.5)
        append(source, T_source_target * p);
    for (const auto& p : second.points())
      if (p.x() > 0.3)
        append(target, p);
  }

  static void
  append(std::vector<double>& xyz, const Eigen::Vector3d& point)
  {
    xyz.insert(xyz.end(), point.data(), point.data() + 3);
  }

  ScanInput<double>
  sourceInput() const
  {
    return inputOf(source, source_viewpoint);
  }

  ScanInput<double>
  targetInput() const
  {
    return inputOf(target, target_viewpoint);
  }

  static ScanInput<double>
  inputOf(const std::vector<double>& xyz, const Eigen::Vector3d& viewpoint)
  {
    ScanInput<double> input;
    input.points.data = xyz.data();
    input.points.size = xyz.size() / 3;
    input.viewpoint = viewpoint;
    input.viewpoint_known = true;
    return input;
  }

  /** \brief How far a pose moves the middle of the room from where it belongs. */
  template <typename Pose>
  double
  error(const Pose& pose) const
  {
    const Eigen::Vector3d middle(1.5, 1.2, 0.6);
    const Eigen::Vector3d there = T_target_source.inverse() * middle;
    return (pose.rotation * there + pose.translation - middle).norm();
  }
};

} // namespace made
} // namespace pcl_flashreg
