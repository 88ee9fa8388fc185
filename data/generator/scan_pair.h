// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "sensors.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <string>

namespace pcl_flashreg::generator {

/** \brief Two scans of one made scene, each in its own sensor frame. */
struct ScanPair {
  Points source;
  Points target;
  /** \brief Maps source points into the target frame; exact. */
  Eigen::Isometry3d T_target_source;
};

/** \brief Makes a pair; the same arguments give the same points.
 * \param[in] scene "indoor" (two fragments fused from a depth camera's images of a
 * furnished room, on a 2.5 cm grid) or "street" (two scans of a spinning lidar)
 * \param[in] seed varies the scene, the viewpoints and the noise
 * \throws std::invalid_argument if the scene is neither
 */
ScanPair
makeScanPair(const std::string& scene, std::uint64_t seed);

/** \brief The seed of the pairs that come with the project. */
constexpr std::uint64_t bundled_seed = 4;

} // namespace pcl_flashreg::generator
