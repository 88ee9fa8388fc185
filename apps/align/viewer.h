// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <Eigen/Core>

namespace pcl_flashreg::align {

/** \brief Whether this program has PCL's viewer. */
extern const bool kViewerBuiltIn;

/** \throws std::runtime_error if there is no display to show anything on */
void
requireDisplay();

/** \brief Shows both clouds before and after in a window until it is closed.
 * \param[in] source N x 3, a column a point
 * \param[in] target M x 3, a column a point
 * \param[in] T_target_source the pose that is shown in the second half
 */
void
showClouds(const Eigen::Matrix3Xd& source,
           const Eigen::Matrix3Xd& target,
           const RigidTransform& T_target_source);

} // namespace pcl_flashreg::align
