// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/information.h"

#include "math/isometry.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace pcl_flashreg {

InformationMatrix
informationMatrix(const Problem& problem,
                  const Pose& pose,
                  const std::vector<int>& inliers,
                  const Vec3& target_centre,
                  double inlier_distance)
{
  // With y = T p, a small motion (w, v) on the left moves y by w x y + v: the Jacobian is
  // [-[y]x, I], and its square needs no more than the moments of y.
  Eigen::Matrix<double, 6, 6> hessian = Eigen::Matrix<double, 6, 6>::Zero();
  double squared_residuals = 0;
  for (const int i : inliers) {
    const Vec3 moved = transform(pose, problem.source(i));
    const Vec3 residual = moved - problem.target(i);
    squared_residuals += dot(residual, residual);
    const Vec3 y = moved + target_centre;
    const Eigen::Matrix3d cross_y = crossMatrix({y.x, y.y, y.z});
    hessian.topLeftCorner<3, 3>() += cross_y.transpose() * cross_y;
    hessian.topRightCorner<3, 3>() += cross_y;
    hessian.bottomRightCorner<3, 3>() += Eigen::Matrix3d::Identity();
  }
  hessian.bottomLeftCorner<3, 3>() = hessian.topRightCorner<3, 3>().transpose();

  // Three residuals a correspondence, six of them used up by the pose.
  const double degrees = std::max(3.0, 3.0 * static_cast<double>(inliers.size()) - 6.0);
  const double floor = 1e-3 * inlier_distance;
  const double variance = std::max(squared_residuals / degrees, floor * floor);
  return hessian / variance;
}

void
forget(const FreeMotion& motion, InformationMatrix& information)
{
  Eigen::Matrix<double, 6, 1> screw;
  if (motion.kind == FreeMotion::Kind::Turn)
    screw << motion.direction, motion.point.cross(motion.direction);
  else
    screw << Eigen::Vector3d::Zero(), motion.direction;
  // What is left is singular along the motion, and the same for all that is conjugate to it.
  const Eigen::Matrix<double, 6, 1> known = information * screw;
  const double along = screw.dot(known);
  if (along > 0)
    information -= known * known.transpose() / along;
}

} // namespace pcl_flashreg
