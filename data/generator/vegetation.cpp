// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "vegetation.h"

#include <cmath>

namespace pcl_flashreg::generator {
namespace {

using Eigen::Vector3d;

/** \brief Leaves spread through an ellipsoid. */
void
addLeaves(const Placer& center, const Vector3d& radii, int leaves, Random& random)
{
  for (int i = 0; i < leaves; ++i) {
    const double z = random.uniform(-1.0, 1.0);
    const double yaw = random.uniform(0.0, 360.0) * degree;
    const double reach = std::sqrt(1.0 - z * z) * std::sqrt(random.uniform());
    center
        .at(radii.x() * reach * std::cos(yaw),
            radii.y() * reach * std::sin(yaw),
            radii.z() * z,
            yaw)
        .turned(random.uniform(0.0, 180.0) * degree, Vector3d::UnitY())
        .cylinder(Vector3d::Zero(), random.uniform(0.08, 0.16), 0.01);
  }
}

} // namespace

void
addBush(const Placer& ground, Random& random)
{
  const double length = random.uniform(0.4, 1.1);
  const double width = random.uniform(0.4, 0.8);
  const double tall = random.uniform(0.4, 0.9);
  const Placer middle = ground.at(0, 0, tall, random.uniform(-0.5, 0.5));
  addLeaves(middle, {length, width, tall}, 120, random);
}

void
addTree(const Placer& ground, Random& random)
{
  const double trunk = random.uniform(1.8, 3.0);
  const double crown = random.uniform(1.3, 2.2);
  const Placer tree =
      ground.turned(random.uniform(-4.0, 4.0) * degree, Vector3d::UnitX());
  tree.cylinder({0, 0, trunk / 2}, random.uniform(0.11, 0.2), trunk);
  for (int i = 0; i < 6; ++i)
    tree.at(0, 0, trunk - 0.2, random.uniform(0.0, 360.0) * degree)
        .turned(random.uniform(10.0, 55.0) * degree, Vector3d::UnitY())
        .cylinder({0, 0, 0.6 * crown}, 0.05, 1.2 * crown);
  addLeaves(
      tree.at(0, 0, trunk + 0.8 * crown), {crown, crown, 0.9 * crown}, 260, random);
}

} // namespace pcl_flashreg::generator
