// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Geometry>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief What is known of how a node lies to another one. */
struct PoseConstraint {
  std::size_t target = 0, source = 0;
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  /** \brief About where a small motion turns, in the frame of the target. */
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  /** \brief Of small motions (turn, shift) of the source against the target: how badly they
   * fit, in squares of what is usual, is xi' hessian xi. */
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  /** \brief By how much it counts. */
  double weight = 1;
};

/** \brief How far the poses are off a constraint: turn and shift of the source about its
 * middle, in the frame of the target. */
Eigen::Matrix<double, 6, 1>
residualOf(const PoseConstraint& constraint,
           const Eigen::Isometry3d& target,
           const Eigen::Isometry3d& source);

/** \brief Moves the poses, all but the first, so that the constraints fit: Levenberg-Marquardt
 * on weight * ln(1 + xi' hessian xi), so that constraints that don't fit lose their say.
 * \param[in,out] poses of the nodes, each tied to the first by constraints */
void
optimize(const std::vector<PoseConstraint>& constraints,
         std::vector<Eigen::Isometry3d>& poses);

} // namespace pcl_flashreg
