// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_scans.h"

#include <cmath>

namespace pcl_flashreg {
namespace made {

/** \brief Two scans of a place that does not say where they were taken. */
struct Views {
  std::vector<double> source, target;
  Eigen::Vector3d source_viewpoint, target_viewpoint;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();

  ScanInput<double>
  sourceInput() const
  {
    return RoomScans::inputOf(source, source_viewpoint);
  }

  ScanInput<double>
  targetInput() const
  {
    return RoomScans::inputOf(target, target_viewpoint);
  }

  /** \brief Into a frame of its own. */
  void
  moveSource(Random& random)
  {
    T_target_source = random.pose(2);
    const Eigen::Isometry3d back = T_target_source.inverse();
    source_viewpoint = back * source_viewpoint;
    for (std::size_t i = 0; i < source.size(); i += 3) {
      Eigen::Map<Eigen::Vector3d> point(&source[i]);
      point = back * point;
    }
  }
};

/** \brief A smooth corridor along x, 2.5 m wide and 2.7 m high, of which a scan sees 8 m to
 * either side; the scans are 2 m apart. */
inline Views
corridor(std::uint64_t seed)
{
  Random random(seed);
  Views views;
  const auto scan = [&](double at, std::vector<double>& xyz) {
    for (int i = 0; i < 40000; ++i) {
      const double x = at + random.uniform(-8, 8), y = random.uniform(-1.25, 1.25),
                   z = random.uniform(0, 2.7), noise = 0.01 * random.normal();
      if (i % 4 < 2)
        RoomScans::append(xyz, {x, y, (i % 4 == 0 ? 0 : 2.7) + noise});
      else
        RoomScans::append(xyz, {x, (i % 4 == 2 ? -1.25 : 1.25) + noise, z});
    }
  };
  views.target_viewpoint = {0, 0.2, 1.2};
  views.source_viewpoint = {2, -0.3, 1.2};
  scan(views.target_viewpoint.x(), views.target);
  scan(views.source_viewpoint.x(), views.source);
  views.moveSource(random);
  return views;
}

/** \brief A bottle of 24 cm that stands on z, seen from two sides that are 60 degrees apart;
 * nothing on it tells which. */
inline Views
bottle(std::uint64_t seed)
{
  struct Ring {
    double radius, height;
  };
  const std::vector<Ring> profile{
      {0.04, 0}, {0.04, 0.12}, {0.03, 0.15}, {0.012, 0.18}, {0.012, 0.24}};
  Random random(seed);
  Views views;
  const auto scan = [&](const Eigen::Vector3d& eye, std::vector<double>& xyz) {
    for (int i = 0; i < 60000; ++i) {
      const std::size_t k = static_cast<std::size_t>(i) % (profile.size() - 1);
      const Ring &low = profile[k], &high = profile[k + 1];
      const double t = random.uniform(0, 1), turn = random.uniform(-3.15, 3.15);
      const double radius = low.radius + t * (high.radius - low.radius);
      const Eigen::Vector3d out(std::cos(turn), std::sin(turn), 0);
      const Eigen::Vector3d normal =
          ((high.height - low.height) * out -
           (high.radius - low.radius) * Eigen::Vector3d::UnitZ())
              .normalized();
      const Eigen::Vector3d point =
          radius * out +
          Eigen::Vector3d(0, 0, low.height + t * (high.height - low.height));
      if (normal.dot(eye - point) > 0.2 * (eye - point).norm())
        RoomScans::append(xyz, point + 0.0005 * random.normal() * normal);
    }
  };
  views.target_viewpoint = {0.6, 0, 0.3};
  views.source_viewpoint = {0.3, 0.52, 0.3};
  scan(views.target_viewpoint, views.target);
  scan(views.source_viewpoint, views.source);
  views.moveSource(random);
  return views;
}

} // namespace made
} // namespace pcl_flashreg
