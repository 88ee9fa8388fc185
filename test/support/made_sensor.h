// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/made_correspondences.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace pcl_flashreg {
namespace made {

/** \brief A hall of 8 m x 6 m x 3 m with boxes on its floor, seen by a sensor that turns:
 * what it sees is hidden by nothing, and thins out with the range. Metres. */
class Hall {
public:
  /** \brief What is seen from a place, by rays in evenly spread directions. */
  static std::vector<Eigen::Vector3d>
  seenFrom(const Eigen::Vector3d& sensor, int rays, std::uint64_t seed)
  {
    constexpr double GOLDEN_ANGLE = 2.399963229728653, NOISE = 0.004;
    Random random(seed);
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < rays; ++i) {
      const double z = 1 - 2 * (i + 0.5) / rays;
      const double r = std::sqrt(1 - z * z), turn = GOLDEN_ANGLE * i;
      const Eigen::Vector3d direction(r * std::cos(turn), r * std::sin(turn), z);
      const double range = rangeAlong(sensor, direction);
      points.push_back(sensor + (range + NOISE * random.normal()) * direction);
    }
    return points;
  }

private:
  using Box = Eigen::AlignedBox3d;

  static Box
  boxAt(double x, double y, double z, double width, double depth, double height)
  {
    const Eigen::Vector3d corner(x, y, z);
    return {corner, corner + Eigen::Vector3d(width, depth, height)};
  }

  static double
  rangeAlong(const Eigen::Vector3d& sensor, const Eigen::Vector3d& direction)
  {
    static const Box boxes[] = {boxAt(1, 0, 0, 1.2, 0.5, 1.9),
                                boxAt(5.5, 1.0, 0, 1.4, 0.8, 0.75),
                                boxAt(2.0, 4.6, 0, 0.6, 0.9, 1.2),
                                boxAt(6.6, 4.0, 0, 0.5, 1.5, 2.2),
                                boxAt(3.4, 2.2, 0, 0.4, 0.4, 0.5),
                                boxAt(0, 3.0, 0, 0.3, 0.8, 2.4),
                                boxAt(4.5, 5.4, 0.9, 1.5, 0.6, 0.7)};
    double nearest = crossing(boxAt(0, 0, 0, 8, 6, 3), sensor, direction).second;
    for (const Box& box : boxes) {
      const auto [enter, leave] = crossing(box, sensor, direction);
      if (enter > 0 && enter < leave)
        nearest = std::min(nearest, enter);
    }
    return nearest;
  }

  /** \brief Ranges at which a ray enters a box and leaves it. */
  static std::pair<double, double>
  crossing(const Box& box,
           const Eigen::Vector3d& from,
           const Eigen::Vector3d& direction)
  {
    double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      double a = (box.min()[axis] - from[axis]) / direction[axis];
      double b = (box.max()[axis] - from[axis]) / direction[axis];
      if (a > b)
        std::swap(a, b);
      enter = std::max(enter, a);
      leave = std::min(leave, b);
    }
    return {enter, leave};
  }
};

} // namespace made
} // namespace pcl_flashreg
