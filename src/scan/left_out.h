// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/pair_registration.h>
#include <pcl_flashreg/point_view.h>

#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief Finds points that can't be part of a surface: see LeftOutPoints.
 * \param[out] kept which of the points of the whole cloud are left, in the order of the
 * view; filled only where any was left out
 */
template <typename Scalar>
LeftOutPoints
findLeftOut(const BasicPointView<Scalar>& points, std::vector<std::int32_t>& kept);

} // namespace pcl_flashreg
