// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// A program for pcl::SampleConsensusPrerejective (PCL's tutorial "Robust pose estimation of
// rigid objects") in which the type of `align` is all that changed.
//   example_drop_in object.pcd scene.pcd

#include <pcl_flashreg/flash_registration.h>

#include <pcl/features/fpfh_omp.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/pcd_io.h>

#include <iostream>

using PointNT = pcl::PointNormal;
using Cloud = pcl::PointCloud<PointNT>;
using Features = pcl::PointCloud<pcl::FPFHSignature33>;

static Features::Ptr
describe(const Cloud::Ptr& cloud, float leaf)
{
  pcl::VoxelGrid<PointNT> grid;
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(cloud);
  grid.filter(*cloud);
  pcl::NormalEstimationOMP<PointNT, PointNT> normals;
  normals.setRadiusSearch(2 * leaf);
  normals.setInputCloud(cloud);
  normals.compute(*cloud);
  pcl::FPFHEstimationOMP<PointNT, PointNT, pcl::FPFHSignature33> estimation;
  estimation.setRadiusSearch(5 * leaf);
  estimation.setInputCloud(cloud);
  estimation.setInputNormals(cloud);
  const Features::Ptr features(new Features);
  estimation.compute(*features);
  return features;
}

int
main(int argc, char** argv)
{
  const Cloud::Ptr object(new Cloud), scene(new Cloud);
  if (argc < 3 || pcl::io::loadPCDFile(argv[1], *object) < 0 ||
      pcl::io::loadPCDFile(argv[2], *scene) < 0)
    return 2;
  const float leaf = 0.05f;
  // was: pcl::SampleConsensusPrerejective<PointNT, PointNT, pcl::FPFHSignature33> align;
  pcl_flashreg::FlashRegistration<PointNT, PointNT, pcl::FPFHSignature33> align;
  align.setSourceFeatures(describe(object, leaf));
  align.setTargetFeatures(describe(scene, leaf));
  align.setInputSource(object);
  align.setInputTarget(scene);
  align.setMaxCorrespondenceDistance(1.5f * leaf);
  Cloud aligned;
  align.align(aligned);
  std::cout << align.getFinalTransformation() << "\n";
  return align.hasConverged() ? 0 : 1;
}
