// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_correspondences.h"

#include <Eigen/Geometry>

#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief Points on the surfaces of a room corner of 3 m x 2.4 m x 2 m with furniture,
 * drawn at random; different seeds sample the same room. Metres. */
class Room {
public:
  Room(std::uint64_t seed, double points_per_square_metre, double noise)
      : random_(seed), density_(points_per_square_metre), noise_(noise)
  {
    using Eigen::Vector3d;
    rectangle({0, 0, 0}, {3, 0, 0}, {0, 2.4, 0});
    rectangle({0, 0, 0}, {3, 0, 0}, {0, 0, 2});
    rectangle({0, 0, 0}, {0, 2.4, 0}, {0, 0, 2});
    box({0.2, 0.1, 0}, {0.9, 0.45, 1.5}, 0);
    box({1.5, 0.5, 0}, {1.1, 0.6, 0.72}, 0.5);
    box({1.75, 0.75, 0.72}, {0.35, 0.25, 0.4}, 0.9);
    box({0.5, 1.5, 0}, {0.5, 0.5, 0.45}, -0.3);
    box({2.3, 1.7, 0}, {0.4, 0.3, 0.9}, 1.1);
    cylinder({1.4, 1.9, 0}, 0.2, 0.8);
    cylinder({0.45, 0.3, 1.5}, 0.13, 0.3);
    cylinder({2.7, 0.3, 0}, 0.1, 1.6);
  }

  const std::vector<Eigen::Vector3d>&
  points() const
  {
    return points_;
  }

private:
  void
  add(const Eigen::Vector3d& point)
  {
    const double x = random_.normal(), y = random_.normal(), z = random_.normal();
    points_.push_back(point + noise_ * Eigen::Vector3d(x, y, z));
  }

  int
  countFor(double area) const
  {
    return static_cast<int>(area * density_);
  }

  void
  rectangle(const Eigen::Vector3d& corner,
            const Eigen::Vector3d& a,
            const Eigen::Vector3d& b)
  {
    for (int i = countFor(a.cross(b).norm()); i > 0; --i) {
      const double u = random_.uniform(0, 1), v = random_.uniform(0, 1);
      add(corner + u * a + v * b);
    }
  }

  /** \brief The top and the four sides, turned by yaw about the vertical at corner. */
  void
  box(const Eigen::Vector3d& corner, const Eigen::Vector3d& size, double yaw)
  {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d a = turn.col(0) * size.x(), b = turn.col(1) * size.y();
    const Eigen::Vector3d c = turn.col(2) * size.z();
    rectangle(corner + c, a, b);
    rectangle(corner, a, c);
    rectangle(corner, b, c);
    rectangle(corner + a, b, c);
    rectangle(corner + b, a, c);
  }

  void
  cylinder(const Eigen::Vector3d& foot, double radius, double height)
  {
    const double circle = 2 * 3.14159265358979323846;
    for (int i = countFor(circle * radius * height); i > 0; --i) {
      const double angle = random_.uniform(0, circle), z = random_.uniform(0, height);
      add(foot +
          Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z));
    }
    for (int i = countFor(circle / 2 * radius * radius); i > 0; --i) {
      const double angle = random_.uniform(0, circle);
      const double r = radius * std::sqrt(random_.uniform(0, 1));
      add(foot + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), height));
    }
  }

  Random random_;
  double density_;
  double noise_;
  std::vector<Eigen::Vector3d> points_;
};

} // namespace made
} // namespace pcl_flashreg
