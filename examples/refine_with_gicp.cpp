// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Global first, then the last millimetre: PCL's GICP from the pose that was found.
//
//   example_refine_with_gicp source.pcd target.pcd

#include <pcl_flashreg/flash_registration.h>

#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>
#include <pcl/registration/gicp.h>

#include <iostream>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

static Cloud::Ptr
thinned(const Cloud::Ptr& cloud, float leaf)
{
  const Cloud::Ptr result(new Cloud);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(cloud);
  grid.filter(*result);
  return result;
}

int
main(int argc, char** argv)
{
  const Cloud::Ptr source(new Cloud), target(new Cloud);
  if (argc < 3 || pcl::io::loadPCDFile(argv[1], *source) < 0 ||
      pcl::io::loadPCDFile(argv[2], *target) < 0)
    return 2;
  pcl_flashreg::FlashRegistration<pcl::PointXYZ, pcl::PointXYZ> global;
  global.setInputSource(source);
  global.setInputTarget(target);
  global.setResolution(0.05);
  Cloud aligned;
  global.align(aligned);
  if (!global.hasConverged())
    return 1; // ICP would only polish a pose that is wrong

  pcl::GeneralizedIterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> fine;
  fine.setInputSource(thinned(source, 0.03f));
  fine.setInputTarget(thinned(target, 0.03f));
  fine.setMaxCorrespondenceDistance(0.1); // two voxels: as far as the pose may be off
  fine.align(aligned, global.getFinalTransformation());
  std::cout << fine.getFinalTransformation() << "\n";
  return fine.hasConverged() ? 0 : 1;
}
