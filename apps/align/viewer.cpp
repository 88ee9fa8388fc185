// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "viewer.h"

#include "modules.h"

#include <cstdlib>
#include <stdexcept>

namespace pcl_flashreg::align {
const bool kViewerBuiltIn = true;

void
requireDisplay()
{
  if (std::getenv("DISPLAY") == nullptr)
    throw std::runtime_error("--view: there is no display (DISPLAY is not set); "
                             "--snapshot draws without one");
}

void
showClouds(const Eigen::Matrix3Xd& source,
           const Eigen::Matrix3Xd& target,
           const RigidTransform& T_target_source)
{
  const Eigen::Matrix3Xd moved =
      (T_target_source.rotation * source).colwise() + T_target_source.translation;
  loadViewer()(
      {source.data(), moved.data(), source.cols(), target.data(), target.cols()});
}

} // namespace pcl_flashreg::align
