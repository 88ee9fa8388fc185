// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "modules.h"

#include <pcl_flashreg/pcl_front_end.h>

void
pcl_flashreg_compute_fpfh(const pcl::PointCloud<pcl::PointXYZ>& cloud,
                          double resolution,
                          unsigned num_threads,
                          pcl_flashreg::FpfhTimings& timings,
                          pcl_flashreg::FpfhCloud& result)
{
  result =
      pcl_flashreg::computeFpfhWithPcl(cloud, {}, resolution, num_threads, &timings);
}
