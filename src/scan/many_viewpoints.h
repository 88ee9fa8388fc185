// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/thread_pool.h"

#include <Eigen/Core>

#include <vector>

namespace pcl_flashreg {

/** \brief Which normals of a surface that was seen from many places (a map) point away from
 * those who saw it.
 *
 * Nobody says where they stood. But whoever stands among surfaces sees some in nearly every
 * direction, and from their front; who stands behind a wall or outside sees little, or backs.
 * So places all over the map vote for the side of what they see, each by the power of the share
 * of directions in which it sees anything; and once more, by the share of fronts among what it
 * sees.
 * The same on any number of threads.
 * \param[in] points finite
 * \param[in] normals one a point, of unit length and either sign
 * \param[in] spacing distance of neighbouring points, > 0
 * \return one a point */
std::vector<bool>
facingAway(const std::vector<Eigen::Vector3f>& points,
           const std::vector<Eigen::Vector3f>& normals,
           float spacing,
           ThreadPool& pool);

} // namespace pcl_flashreg
