// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "random.h"
#include "scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl_flashreg::generator {

/** \brief Points in a sensor's own frame, metres. */
using Points = std::vector<Eigen::Vector3f>;

/** \brief A depth camera of the structured-light kind; frame: x right, y down, z
 * forward. */
struct DepthCamera {
  int width = 640;
  int height = 480;
  /** \brief Only every n-th row and column is simulated. */
  int stride = 2;
  double focal_length_px = 525.0;
  double min_depth = 0.5;
  double max_depth = 3.8;
  /** \brief Depth noise: sigma = noise_floor + noise_growth * (depth - 0.4)^2. */
  double noise_floor = 0.0012;
  double noise_growth = 0.0019;
  /** \brief Depths are multiples of quantisation * depth^2, the step of the disparity.
   */
  double quantisation = 0.0028;
  /** \brief Pixels beside a jump of more than this share of the depth are unreliable
   * ... */
  double edge_jump = 0.04;
  /** \brief ... and lost with this probability, or else pulled across the jump with the
   * other. */
  double edge_dropout = 0.6;
  double edge_mixing = 0.15;
  /** \brief Surfaces seen at more than this angle (cosine of it) from their normal are
   * lost. */
  double grazing_cosine = 0.17;
};

/** \brief One depth image from T_world_camera as points in the camera frame. */
Points
capture(const DepthCamera& camera,
        const Scene& scene,
        const Eigen::Isometry3d& T_world_camera,
        Random& random);

/** \brief A spinning lidar with its frame at the sensor: x forward, y left, z up. */
struct Lidar {
  int rings = 64;
  double min_elevation_deg = -24.8;
  double max_elevation_deg = 2.0;
  double azimuth_step_deg = 0.4;
  double min_range = 2.5;
  double max_range = 80.0;
  /** \brief Standard deviation along the ray, metres. */
  double range_noise = 0.02;
  /** \brief Share of the returns lost at range 0 and, growing in proportion to the
   * range, at max_range; surfaces seen at a grazing angle lose more. */
  double dropout_near = 0.02;
  double dropout_far = 0.40;
  double grazing_cosine = 0.03;
};

/** \brief One revolution, with the sensor at rest, in the lidar frame. */
Points
capture(const Lidar& lidar,
        const Scene& scene,
        const Eigen::Isometry3d& T_world_lidar,
        Random& random);

/** \brief Replaces the points of each cell of a grid by their mean, in the order of the
 * cells.
 * \param[in] cell_size metres
 * \param[in] min_points cells with fewer points are left out: noise, as a rule */
Points
thin(const Points& points, float cell_size, std::size_t min_points);

} // namespace pcl_flashreg::generator
