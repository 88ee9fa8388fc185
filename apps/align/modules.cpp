// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "modules.h"

#include "../program/modules.h"

namespace pcl_flashreg::align {

ShowClouds
loadViewer()
{
  return reinterpret_cast<ShowClouds>(
      program::loadFunction("pcl_flashreg_viewer.so", "pcl_flashreg_show_clouds"));
}

DrawSnapshot
loadSnapshot()
{
  return reinterpret_cast<DrawSnapshot>(
      program::loadFunction("pcl_flashreg_snapshot.so", "pcl_flashreg_draw_snapshot"));
}

ComputeFpfh
loadPclFeatures()
{
  return reinterpret_cast<ComputeFpfh>(program::loadFunction(
      "pcl_flashreg_pcl_features.so", "pcl_flashreg_compute_fpfh"));
}

} // namespace pcl_flashreg::align
