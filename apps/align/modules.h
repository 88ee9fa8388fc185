// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>

#include <cstddef>
#include <string>

// Parts of the program that are loaded when they are asked for: PCL's and VTK's
// libraries take longer to load than most runs take in all, Cairo's as long as the rest
// of the program.

namespace pcl_flashreg::align {

/** \brief What is shown or drawn: plain arrays, x, y, z of a point after the other. */
struct ShownClouds {
  const double* source;
  /** \brief The source under the pose. */
  const double* moved_source;
  std::ptrdiff_t source_size;
  const double* target;
  std::ptrdiff_t target_size;
};

/** \brief Shows both clouds before and after in a window until it is closed. */
using ShowClouds = void (*)(const ShownClouds& clouds);

/** \brief Draws both clouds before and after into the bytes of a PNG file. */
using DrawSnapshot = void (*)(const ShownClouds& clouds, std::string& png);

/** \brief computeFpfhWithPcl() into `result`. */
using ComputeFpfh = void (*)(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                             double resolution,
                             unsigned num_threads,
                             FpfhTimings& timings,
                             FpfhCloud& result);

/** \throws std::runtime_error if the module is not where the program looks for it */
ShowClouds
loadViewer();

/** \throws std::runtime_error if the module is not where the program looks for it */
DrawSnapshot
loadSnapshot();

/** \throws std::runtime_error if the module is not where the program looks for it */
ComputeFpfh
loadPclFeatures();

} // namespace pcl_flashreg::align

/** \brief What the modules offer. */
extern "C" {
void
pcl_flashreg_show_clouds(const pcl_flashreg::align::ShownClouds& clouds);
void
pcl_flashreg_draw_snapshot(const pcl_flashreg::align::ShownClouds& clouds,
                           std::string& png);
void
pcl_flashreg_compute_fpfh(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                          double resolution,
                          unsigned num_threads,
                          pcl_flashreg::FpfhTimings& timings,
                          pcl_flashreg::FpfhCloud& result);
}
