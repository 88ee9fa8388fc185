// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <Eigen/Core>

#include <optional>
#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief A rigid transform from the upper three rows of a matrix: the rotation is made exactly
 * orthonormal, so that one that was printed with few digits is let pass; nothing if it is
 * none. */
std::optional<RigidTransform>
rigidOf(const Eigen::Matrix<double, 3, 4>& matrix);

/** \brief A 4 x 4 matrix as a rigid transform, with its rotation made exactly orthonormal.
 * \throws InputError if it is none
 */
RigidTransform
toRigidTransform(const Eigen::Matrix4d& matrix);

/** \brief Reads a rigid transform.
 *
 * A 4 x 4 or 3 x 4 matrix by rows, on one line or several. The rotation is made exactly
 * orthonormal.
 * \throws InputError if the numbers are no rigid transform
 */
RigidTransform
parseTransform(std::string_view text);

/** \brief The 4 x 4 matrix, a row a line, with all 17 digits of a double. */
std::string
formatTransform(const RigidTransform& transform);

} // namespace pcl_flashreg::io
