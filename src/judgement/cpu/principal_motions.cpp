// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/principal_motions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr Reach TOUCHING{1000, 1.5f, 0.85f};
constexpr std::size_t MIN_CONTACTS = 10;

double
spreadOf(const std::vector<Contact>& contacts, const Eigen::Vector3d& middle)
{
  double squared = 0;
  for (const Contact& contact : contacts)
    squared += (contact.place.cast<double>() - middle).squaredNorm();
  return std::sqrt(squared / static_cast<double>(contacts.size()));
}

} // namespace

std::vector<Contact>
contactsForMotions(const SurfacePair& clouds, const Pose& pose)
{
  return contactsOfBoth(clouds, toRigidFloat(pose), TOUCHING);
}

std::vector<Motion>
principalMotions(const SurfacePair& clouds, const Pose& pose)
{
  return principalMotions(contactsForMotions(clouds, pose));
}

std::vector<Motion>
principalMotions(const std::vector<Contact>& contacts)
{
  if (contacts.size() < MIN_CONTACTS)
    return {};
  const Eigen::Vector3d middle = middleOf(contacts);
  const double spread = spreadOf(contacts, middle);
  if (!(spread > 0))
    return {};
  Matrix6 hessian = Matrix6::Zero();
  for (const Contact& contact : contacts) {
    const Vector6 jacobian =
        jacobianOf(contact, (contact.place.cast<double>() - middle) / spread);
    hessian += jacobian * jacobian.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Matrix6> solver(hessian);
  std::vector<Motion> motions;
  for (int i = 0; i < 6; ++i) {
    const Vector6 motion = solver.eigenvectors().col(i);
    motions.push_back({middle,
                       motion.head<3>() / spread,
                       motion.tail<3>(),
                       std::max(0.0, solver.eigenvalues()[i]) /
                           static_cast<double>(contacts.size())});
  }
  return motions;
}

Pose
moveAlong(const Pose& pose, const Motion& motion, double way)
{
  const Eigen::Vector3d turn = way * motion.turn, shift = way * motion.shift;
  const double angle = turn.norm();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = shift;
  if (angle > 1e-9) {
    // The exponential of a twist (Murray, Li, Sastry 1994, Proposition 2.9).
    const Eigen::Vector3d axis = turn / angle;
    rotation = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    const Eigen::Vector3d sideways = axis.cross(shift) / angle;
    translation = sideways - rotation * sideways + axis * axis.dot(shift);
  }
  using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Eigen::Map<const RowMajor> R(pose.r);
  const Eigen::Map<const Eigen::Vector3d> t(pose.t);
  Pose moved;
  Eigen::Map<RowMajor>(moved.r) = rotation * R;
  Eigen::Map<Eigen::Vector3d>(moved.t) =
      rotation * (t - motion.middle) + motion.middle + translation;
  return moved;
}

} // namespace pcl_flashreg
