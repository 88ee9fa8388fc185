// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "camera.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pcl_flashreg::align {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
/** \brief Tangent of half the field of view. */
const double kHalfWidth = std::tan(18 * kDegree);
/** \brief Share of the points on either side that need not be in the picture. */
constexpr double kOutside = 0.01;

double
quantile(std::vector<double> values, double share)
{
  if (values.empty())
    return 0;
  const auto k = static_cast<std::ptrdiff_t>(share * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + k, values.end());
  return values[static_cast<std::size_t>(k)];
}

std::vector<double>
rowOf(const Eigen::Matrix3Xd& xyz, int row)
{
  std::vector<double> values(static_cast<std::size_t>(xyz.cols()));
  Eigen::VectorXd::Map(values.data(), xyz.cols()) = xyz.row(row).transpose();
  return values;
}

/** \brief Middle of the box that holds nearly all of the points. */
Eigen::Vector3d
middleOf(const Eigen::Matrix3Xd& xyz)
{
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> values = rowOf(xyz, axis);
    middle[axis] = 0.5 * (quantile(values, kOutside) + quantile(values, 1 - kOutside));
  }
  return middle;
}

/** \brief Whether nearly all points lie in front of a camera at the origin. */
bool
isDepthCameraFrame(const Eigen::Matrix3Xd& xyz)
{
  Eigen::Index inside = 0;
  for (const auto& p : xyz.colwise())
    inside +=
        p.z() > 0 && std::abs(p.x()) < 1.5 * p.z() && std::abs(p.y()) < 1.5 * p.z();
  return inside >= 0.95 * static_cast<double>(xyz.cols());
}

/** \brief How far from the origin, along z, a viewer has to be to see nearly all
 * points. */
double
fittingDistance(const Eigen::Matrix3Xd& seen)
{
  std::vector<double> distances(static_cast<std::size_t>(seen.cols()));
  for (Eigen::Index i = 0; i < seen.cols(); ++i) {
    const auto& p = seen.col(i);
    distances[static_cast<std::size_t>(i)] =
        p.z() + std::max(std::abs(p.x()), std::abs(p.y())) / kHalfWidth;
  }
  return std::max(1e-9, 1.05 * quantile(distances, 1 - 2 * kOutside));
}

ViewDirection
directionFrom(const Eigen::Vector3d& toward_viewer, const Eigen::Vector3d& upwards)
{
  ViewDirection direction;
  direction.toward_viewer = toward_viewer.normalized();
  direction.right = upwards.cross(direction.toward_viewer).normalized();
  direction.up = direction.toward_viewer.cross(direction.right);
  return direction;
}

} // namespace

ViewDirection
chooseViewDirection(const Eigen::Matrix3Xd& xyz)
{
  if (xyz.cols() > 0 && isDepthCameraFrame(xyz))
    return directionFrom({0.35, -0.35, -1}, {0, -1, 0});
  const Eigen::Matrix3Xd centred = xyz.colwise() - middleOf(xyz);
  const Eigen::Matrix3d scatter = centred * centred.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Eigen::Vector3d up = solver.eigenvectors().col(0);
  Eigen::Vector3d front = solver.eigenvectors().col(1);
  // Most clouds that are flat along z have z upwards; others are looked at from the
  // side on which the sensor, at the origin, stood.
  const bool flip = std::abs(up.z()) > 0.5 ? up.z() < 0 : up.dot(middleOf(xyz)) > 0;
  if (flip)
    up = -up;
  // One of two signs, but the same for both clouds of a pair and in every run.
  if (front.sum() > 0)
    front = -front;
  constexpr double tilt = 42 * kDegree;
  return directionFrom(std::cos(tilt) * up + std::sin(tilt) * front, up);
}

Camera::Camera(const ViewDirection& direction, const Eigen::Matrix3Xd& xyz)
{
  R_view_world_ << direction.right.transpose(), direction.up.transpose(),
      direction.toward_viewer.transpose();
  const Eigen::Matrix3Xd seen = R_view_world_ * xyz;
  const Eigen::Vector3d middle = middleOf(seen);
  distance_ = fittingDistance(seen.colwise() - middle);
  centre_ = R_view_world_.transpose() * middle;
}

Eigen::Vector3d
Camera::project(const Eigen::Vector3d& point) const
{
  const Eigen::Vector3d p = R_view_world_ * (point - centre_);
  const double depth = distance_ - p.z();
  return {p.x() / (depth * kHalfWidth), p.y() / (depth * kHalfWidth), depth};
}

} // namespace pcl_flashreg::align
