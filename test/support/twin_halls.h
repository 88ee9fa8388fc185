// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_hall_scans.h"
#include "support/made_room.h"

#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief Two halls that are the same, 20 m apart, and beside the second one a room: who walks
 * from a hall into the room was in the second. */
struct TwinHalls {
  static constexpr double RESOLUTION = 0.1;

  TwinHalls()
  {
    // Other points of the same surfaces in either hall, and in the scans.
    for (const int rays : {15000, 15013}) {
      const HallScans hall(true, rays);
      const Eigen::Vector3d shift = rays == 15000 ? Eigen::Vector3d::Zero() : apart();
      for (std::size_t i = 0; i < hall.scans.size(); ++i)
        for (const Eigen::Vector3d& point : hall.scans[i])
          map.push_back(hall.T_hall_scan[i] * point + shift);
    }
    const Room mapped(7, 800, 0.004), scanned(11, 800, 0.004);
    for (const Eigen::Vector3d& point : mapped.points())
      map.push_back(point + room());
    const HallScans hall(true, 10000);
    for (const std::size_t i : {1, 2, 3}) {
      scans.push_back(hall.scans[i]);
      T_map_scan.push_back(Eigen::Translation3d(apart()) * hall.T_hall_scan[i]);
    }
    Eigen::Isometry3d in_room(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()));
    in_room.pretranslate(room() + Eigen::Vector3d(1, 1, 1));
    scans.emplace_back();
    for (const Eigen::Vector3d& point : scanned.points())
      scans.back().push_back(in_room.inverse() * (point + room()));
    T_map_scan.push_back(in_room);
  }

  static Eigen::Vector3d
  apart()
  {
    return {0, 20, 0};
  }

  static Eigen::Vector3d
  room()
  {
    return {9, 20, 0};
  }

  /** \brief In a frame of the sequence's own, which drifts with every scan. */
  std::vector<RigidTransform>
  odometry(double drift = 0) const
  {
    Eigen::Isometry3d own(
        Eigen::AngleAxisd(-1.1, Eigen::Vector3d(1, 2, 3).normalized()));
    own.pretranslate(Eigen::Vector3d(3, -5, 2));
    Eigen::Isometry3d off = Eigen::Isometry3d::Identity();
    std::vector<RigidTransform> poses;
    for (const Eigen::Isometry3d& T : T_map_scan) {
      const Eigen::Isometry3d pose = own * off * T_map_scan.front().inverse() * T;
      poses.push_back({pose.rotation(), pose.translation()});
      off = off * Eigen::Translation3d(drift, -drift, 0) *
            Eigen::AngleAxisd(drift / 10, Eigen::Vector3d::UnitZ());
    }
    return poses;
  }

  /** \brief How far a pose of a scan is off, in metres, a metre away from it. */
  double
  errorOf(const RigidTransform& T, std::size_t scan) const
  {
    const Eigen::Vector3d far(0.6, 0.6, 0.6);
    return (T.toIsometry() * far - T_map_scan[scan] * far).norm();
  }

  std::vector<Eigen::Vector3d> map;
  /** \brief Three of the hall, whose origin is the sensor, and one of the room, of whose sensor
   * nothing is known. */
  std::vector<std::vector<Eigen::Vector3d>> scans;
  std::vector<Eigen::Isometry3d> T_map_scan;
};

} // namespace made
} // namespace pcl_flashreg
