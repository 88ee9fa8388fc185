// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/cpu/agreement.h"
#include "multiview/pose_graph.h"

#include <optional>

namespace pcl_flashreg {

/** \brief What the surfaces of two scans say of a small motion, where they touch: the
 * point-to-plane Hessian of both clouds' contacts.
 * \param[in] T_target_source between middles, on the surface
 * \return nothing if they don't touch enough to tell */
std::optional<PoseConstraint>
surfaceConstraint(const SurfacePair& clouds, const Eigen::Isometry3d& T_target_source);

} // namespace pcl_flashreg
