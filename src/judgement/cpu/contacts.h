// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "math/rigid_float.h"

#include <vector>

namespace pcl_flashreg {

/** \brief Which points are drawn to which planes. */
struct Reach {
  /** \brief Points that are asked at most, spread evenly over their numbers. */
  std::size_t points;
  /** \brief Largest distance from the plane's point, in spacings. */
  float radius;
  /** \brief Of the normals. */
  float min_cosine;
};

/** \brief A point of the source where the pose takes it, and the tangent plane of the target
 * that it is drawn to. */
struct Contact {
  Eigen::Vector3f place;
  Eigen::Vector3f normal;
  float residual;
};

/** \brief Appends what the source's points touch. */
void
findContacts(const SurfacePair& clouds,
             const RigidFloat& pose,
             const Reach& reach,
             std::vector<Contact>& contacts);

/** \brief What either cloud's points touch, in the target's frame, so that the order of the
 * clouds makes no difference. */
std::vector<Contact>
contactsOfBoth(const SurfacePair& clouds, const RigidFloat& pose, const Reach& reach);

/** \brief The mean of their places. */
Eigen::Vector3d
middleOf(const std::vector<Contact>& contacts);

/** \brief How the distance to the plane changes with a turn and a shift, for a point with
 * this arm. */
Eigen::Matrix<double, 6, 1>
jacobianOf(const Contact& contact, const Eigen::Vector3d& arm);

} // namespace pcl_flashreg
