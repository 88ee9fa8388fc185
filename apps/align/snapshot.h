// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <Eigen/Core>

#include <string>

namespace pcl_flashreg::align {

/** \brief Whether this program can draw. */
extern const bool kSnapshotBuiltIn;

/** \brief Draws both clouds, before and after, side by side into a PNG file.
 *
 * Software only: no display and no GPU is needed.
 * \param[in] path where the picture goes
 * \param[in] source N x 3, a column a point
 * \param[in] target M x 3, a column a point
 * \param[in] T_target_source the pose that is shown in the second panel
 * \throws io::InputError if the file can't be written
 */
void
writeSnapshot(const std::string& path,
              const Eigen::Matrix3Xd& source,
              const Eigen::Matrix3Xd& target,
              const RigidTransform& T_target_source);

} // namespace pcl_flashreg::align
