// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"
#include "judgement/cpu/agreement.h"

namespace pcl_flashreg {

/** \brief Whether a pose tilts by so many degrees more than it may, or less where they are
 * below 0; false of rigid motions. */
bool
tiltsBeyond(const Upright& upright, const Pose& pose, double degrees);

/** \brief Evidence::tilted.
 *
 * Where the direction of gravity is wrong, what is found is the right pose turned back as far
 * as it may tilt. Once gravity is let go, correspondences and surfaces take it to the
 * right one again; of a right pose they change next to nothing.
 * \param[in] clouds null where there are none
 * \param[in] pose that was found */
double
tiltedEvidence(const Problem& problem,
               const SurfacePair* clouds,
               const Pose& pose,
               float inlier_distance);

} // namespace pcl_flashreg
