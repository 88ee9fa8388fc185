// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "judgement/cpu/contacts.h"

#include <Eigen/Geometry>

#include <optional>

namespace pcl_flashreg {

/** \brief Moves a pose that is nearly right so that the source's points come to lie on
 * the target's surface: a few rounds of point-to-plane alignment. Directions that the
 * surfaces don't constrain are left alone.
 * \param[in] pose T_target_source, right to within about two spacings
 */
Pose
moveOntoTarget(const SurfacePair& clouds, const Pose& pose);

/** \brief What one round of it does, for whoever has other contacts: a turn about the middle
 * of the places, and a shift. */
struct PlaneStep {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  Eigen::Vector3d
  operator*(const Eigen::Vector3d& place) const
  {
    return rotation * (place - middle) + middle + shift;
  }
};

/** \brief Rounds of moveOntoTarget(). */
constexpr int PLANE_ROUNDS = 6;

/** \brief Which contacts a round looks for. */
Reach
reachOf(int round);

/** \brief One step of Gauss-Newton on the distances to the planes.
 * \return nothing where they don't tell */
std::optional<PlaneStep>
stepOntoPlanes(const std::vector<Contact>& contacts, float spacing);

} // namespace pcl_flashreg
