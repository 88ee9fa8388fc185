// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Two clouds to a pose, and whether to trust it.
//
//   example_pair source.pcd target.pcd

#include <pcl_flashreg/flash_registration.h>

#include <pcl/io/pcd_io.h>

#include <iostream>

int
main(int argc, char** argv)
{
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  const Cloud::Ptr source(new Cloud), target(new Cloud);
  if (argc < 3 || pcl::io::loadPCDFile(argv[1], *source) < 0 ||
      pcl::io::loadPCDFile(argv[2], *target) < 0)
    return 2;
  pcl_flashreg::FlashRegistration<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setResolution(0.05); // the voxel size; without it, it is estimated
  Cloud aligned;
  registration.align(aligned);
  std::cout << registration.getFinalTransformation() << "\n"
            << (registration.hasConverged() ? "trusted" : "not trusted")
            << ", confidence " << registration.getConfidence() << "\n";
  return registration.hasConverged() ? 0 : 1;
}
