// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/surface_constraint.h"

#include "judgement/cpu/contacts.h"
#include "math/isometry.h"

namespace pcl_flashreg {
namespace {

constexpr Reach TOUCHING{400, 1.5f, 0.7f};
constexpr std::size_t LEAST_CONTACTS = 20;
/** \brief How far off its plane a point is, usually, in spacings. */
constexpr double USUAL = 0.5;
/** \brief What holds a motion that no plane opposes, as a share. */
constexpr double STIFFNESS = 0.003;

} // namespace

std::optional<PoseConstraint>
surfaceConstraint(const SurfacePair& clouds, const Eigen::Isometry3d& T_target_source)
{
  const std::vector<Contact> contacts =
      contactsOfBoth(clouds, toRigidFloat(toPose(T_target_source)), TOUCHING);
  if (contacts.size() < LEAST_CONTACTS)
    return std::nullopt;
  PoseConstraint constraint;
  constraint.T_target_source = T_target_source;
  constraint.middle = middleOf(contacts);
  double spread = 0;
  for (const Contact& contact : contacts) {
    const Eigen::Vector3d arm = contact.place.cast<double>() - constraint.middle;
    const Eigen::Matrix<double, 6, 1> jacobian = jacobianOf(contact, arm);
    constraint.hessian += jacobian * jacobian.transpose();
    spread += arm.squaredNorm();
  }
  const auto count = static_cast<double>(contacts.size());
  constraint.hessian.diagonal().head<3>().array() += STIFFNESS * spread;
  constraint.hessian.diagonal().tail<3>().array() += STIFFNESS * count;
  constraint.hessian /= count * USUAL * clouds.spacing * USUAL * clouds.spacing;
  constraint.weight = count;
  return constraint;
}

} // namespace pcl_flashreg
