// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <pcl_flashreg/scan.h>

namespace pcl_flashreg::io {

/** \brief A cloud that was read, for a scan to be made from: the sensor stood at its
 * VIEWPOINT.
 * \param[in] xyz coordinates() of the cloud; the caller keeps them
 * \param[in] viewpoint_known if not, what the file says is nobody's wish either: the points
 * tell where to turn normals */
inline ScanInput<double>
scanInput(const Cloud& cloud, const Eigen::Matrix3Xd& xyz, bool viewpoint_known = true)
{
  ScanInput<double> input;
  input.points.data = xyz.data();
  input.points.size = static_cast<std::size_t>(xyz.cols());
  if (viewpoint_known)
    input.viewpoint = Eigen::Vector3d(cloud.viewpoint.data());
  input.viewpoint_known = viewpoint_known;
  return input;
}

} // namespace pcl_flashreg::io
