// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/vec3.h"

#include <pcl_flashreg/cloud_view.h>
#include <pcl_flashreg/scan.h>

namespace pcl_flashreg {

/** \brief A scan as a cloud that judges poses: all coordinates relative to its shift. */
inline CloudView<float>
viewOf(const Scan& scan)
{
  CloudView<float> view{scan.points(), scan.normals(), scan.size(), std::nullopt};
  view.normals_oriented = scan.normalsOriented();
  if (scan.viewpoint())
    view.viewpoint = *scan.viewpoint() - scan.shift();
  return view;
}

inline Vec3
shiftOf(const Scan& scan)
{
  return {scan.shift().x(), scan.shift().y(), scan.shift().z()};
}

} // namespace pcl_flashreg
