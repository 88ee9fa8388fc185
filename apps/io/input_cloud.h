// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <cstddef>
#include <string>

namespace pcl_flashreg::io {

/** \brief A cloud as it was read, and its coordinates. */
struct InputCloud {
  std::string path;
  Cloud cloud;
  Eigen::Matrix3Xd xyz;
};

/** \param[in] raw_row_length as for readCloud()
 * \throws InputError as readCloud(), or if there are no coordinates */
InputCloud
readInputCloud(const std::string& path, std::size_t raw_row_length);

/** \brief Three finite points, not all in one place, are the least to find a pose from.
 * \throws InputError if there are fewer */
void
checkPoints(const InputCloud& input);

/** \brief What the cloud by itself would be seen at.
 * \throws std::invalid_argument if it has fewer than two distinct finite points */
double
resolutionOf(const InputCloud& input);

} // namespace pcl_flashreg::io
