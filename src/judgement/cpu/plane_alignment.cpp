// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "judgement/cpu/plane_alignment.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>
#include <vector>

namespace pcl_flashreg {
namespace {

/** \brief Points of the source that are used at most. */
constexpr std::size_t POINTS = 400;
/** \brief Distance of a point from its plane's point, in spacings, in the first round and
 * in the last. */
constexpr float FIRST_RADIUS = 2, LAST_RADIUS = 1;
/** \brief Cosine of the normals, about 45 degrees. */
constexpr float MIN_COSINE = 0.7f;
/** \brief Residual that halves a point's weight, in spacings. */
constexpr float SOFTNESS = 0.5f;
constexpr std::size_t MIN_PLANES = 10;
/** \brief Stiffness that holds a direction which few planes constrain, a point. */
constexpr double STIFFNESS = 0.01;

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

} // namespace

Reach
reachOf(int round)
{
  const float t = static_cast<float>(round) / (PLANE_ROUNDS - 1);
  return {POINTS, FIRST_RADIUS + t * (LAST_RADIUS - FIRST_RADIUS), MIN_COSINE};
}

std::optional<PlaneStep>
stepOntoPlanes(const std::vector<Contact>& contacts, float spacing)
{
  if (contacts.size() < MIN_PLANES)
    return std::nullopt;
  const float softness = SOFTNESS * spacing;
  PlaneStep step;
  step.middle = middleOf(contacts);
  Matrix6 hessian = Matrix6::Zero();
  Vector6 gradient = Vector6::Zero();
  double spread = 0;
  for (const Contact& contact : contacts) {
    const Eigen::Vector3d arm = contact.place.cast<double>() - step.middle;
    const Vector6 jacobian = jacobianOf(contact, arm);
    const double scaled = contact.residual / softness;
    const double weight = 1 / (1 + scaled * scaled);
    hessian += weight * jacobian * jacobian.transpose();
    gradient += weight * contact.residual * jacobian;
    spread += arm.squaredNorm();
  }
  hessian.diagonal().head<3>().array() += STIFFNESS * spread;
  hessian.diagonal().tail<3>().array() +=
      STIFFNESS * static_cast<double>(contacts.size());
  const Vector6 motion = -hessian.ldlt().solve(gradient);
  const Eigen::Vector3d turn = motion.head<3>();
  const double angle = turn.norm();
  if (!motion.allFinite() || !(angle > 0))
    return PlaneStep();
  step.rotation = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  step.shift = motion.tail<3>();
  return step;
}

namespace {

/** \brief Turned back about the middle of the step's contacts, where it tilts too much. */
void
keepUpright(const Upright& upright, const PlaneStep& step, RigidFloat& moved)
{
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const Rows before = moved.rotation.cast<double>();
  Rows after = before;
  if (!limitTilt(upright, after.data()))
    return;
  const Eigen::Vector3d middle = step.middle + step.shift;
  const Eigen::Vector3d arm = moved.translation.cast<double>() - middle;
  moved.translation = (after * before.transpose() * arm + middle).cast<float>();
  moved.rotation = after.cast<float>();
}

} // namespace

Pose
moveOntoTarget(const SurfacePair& clouds, const Pose& pose)
{
  RigidFloat moved = toRigidFloat(pose);
  std::vector<Contact> contacts;
  for (int round = 0; round < PLANE_ROUNDS; ++round) {
    contacts.clear();
    findContacts(clouds, moved, reachOf(round), contacts);
    const std::optional<PlaneStep> step = stepOntoPlanes(contacts, clouds.spacing);
    if (!step)
      break;
    const Eigen::Vector3d shifted = *step * moved.translation.cast<double>();
    moved.rotation = (step->rotation * moved.rotation.cast<double>()).cast<float>();
    moved.translation = shifted.cast<float>();
    keepUpright(clouds.upright, *step, moved);
  }
  Pose result;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(result.r) =
      Eigen::Quaterniond(moved.rotation.cast<double>()).normalized().toRotationMatrix();
  Eigen::Map<Eigen::Vector3d>(result.t) = moved.translation.cast<double>();
  // What single precision lost.
  limitTilt(clouds.upright, result.r);
  return result;
}

} // namespace pcl_flashreg
