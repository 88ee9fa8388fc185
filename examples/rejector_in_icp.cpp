// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The rejector in an ICP of PCL's: pairs that no rigid motion explains are dropped before every
// step. ICP alone needs a pose to begin with; this one is a little off.
//
//   example_rejector_in_icp cloud.pcd

#include <pcl_flashreg/correspondence_rejector_flashreg.h>

#include <pcl/common/transforms.h>
#include <pcl/io/pcd_io.h>
#include <pcl/registration/icp.h>

#include <iostream>

int
main(int argc, char** argv)
{
  using Cloud = pcl::PointCloud<pcl::PointXYZ>;
  const Cloud::Ptr target(new Cloud), source(new Cloud);
  if (argc < 2 || pcl::io::loadPCDFile(argv[1], *target) < 0)
    return 2;
  Eigen::Affine3f off = Eigen::Affine3f::Identity();
  off.rotate(Eigen::AngleAxisf(0.05f, Eigen::Vector3f::UnitZ()));
  off.translate(Eigen::Vector3f(0.05f, 0.02f, -0.03f));
  pcl::transformPointCloud(*target, *source, off);

  const pcl_flashreg::CorrespondenceRejectorFlashReg<pcl::PointXYZ>::Ptr rejector(
      new pcl_flashreg::CorrespondenceRejectorFlashReg<pcl::PointXYZ>);
  rejector->setInlierThreshold(0.1);
  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ> icp;
  icp.addCorrespondenceRejector(rejector);
  icp.setMaxCorrespondenceDistance(0.5);
  icp.setMaximumIterations(30);
  icp.setInputSource(source);
  icp.setInputTarget(target);
  Cloud aligned;
  icp.align(aligned);
  const Eigen::Matrix4f left = icp.getFinalTransformation() * off.matrix();
  std::cout << "left over: " << (left - Eigen::Matrix4f::Identity()).norm() << "\n";
  return (left - Eigen::Matrix4f::Identity()).norm() < 0.01f ? 0 : 1;
}
