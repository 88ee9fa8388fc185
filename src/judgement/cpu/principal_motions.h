// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "judgement/cpu/contacts.h"

#include <vector>

namespace pcl_flashreg {

/** \brief A way to move the source about a pose: a screw in the target's frame. */
struct Motion {
  /** \brief The middle of the points that match, about which it turns. */
  Eigen::Vector3d middle;
  /** \brief Turn and shift that move these points by about 1, in the root mean square. */
  Eigen::Vector3d turn, shift;
  /** \brief Mean square of how far they leave their planes then: 0 for a motion that the
   * surfaces leave free. */
  double stiffness = 0;
};

/** \brief The eigenvectors of the point-to-plane Hessian, the softest first; none, if next to
 * nothing matches. Points of both clouds count, so that their order makes no difference.
 *
 * After Gelfand, Ikemoto, Rusinkiewicz and Levoy, Geometrically stable sampling for the ICP
 * algorithm (3DIM 2003): arms in units of their own spread make turns and shifts comparable. */
std::vector<Motion>
principalMotions(const SurfacePair& clouds, const Pose& pose);

/** \brief The same of several clouds, in the frame of all their contacts. */
std::vector<Motion>
principalMotions(const std::vector<Contact>& contacts);

/** \brief What tells the motions of a pose: what either cloud's points touch. */
std::vector<Contact>
contactsForMotions(const SurfacePair& clouds, const Pose& pose);

/** \brief The pose, moved on along the screw.
 * \param[in] way that the points go, about, in the unit of the clouds */
Pose
moveAlong(const Pose& pose, const Motion& motion, double way);

} // namespace pcl_flashreg
