// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {

/** \tparam View what has source_xyz, target_xyz and size, wherever these point
 * \param[in] name for who reads the error
 * \throws std::invalid_argument */
template <typename View>
void
checkCorrespondences(const View& in, const std::string& name = "correspondences")
{
  if (in.size > 0 && (!in.source_xyz || !in.target_xyz))
    throw std::invalid_argument(name + ": size is " + std::to_string(in.size) +
                                ", but source_xyz or target_xyz is null");
  if (in.size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::invalid_argument(name + ": size " + std::to_string(in.size) +
                                " is out of range: it must fit an int");
}

} // namespace pcl_flashreg
