// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"

namespace pcl_flashreg {

/** \brief Moves a pose that is nearly right so that the source's points come to lie on
 * the target's surface: a few rounds of point-to-plane alignment. Directions that the
 * surfaces don't constrain are left alone.
 * \param[in] pose T_target_source, right to within about two spacings
 */
Pose
moveOntoTarget(const SurfacePair& clouds, const Pose& pose);

} // namespace pcl_flashreg
