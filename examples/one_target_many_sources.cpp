// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// A target that many sources are registered to: what it takes of a cloud is made once.
//
//   example_one_target_many_sources target.pcd source.pcd...

#include <pcl_flashreg/pair_registration.h>

#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

using namespace pcl_flashreg;

static Scan
read(PairRegistration& registration, const std::string& path)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  if (pcl::io::loadPCDFile(path, cloud) < 0)
    throw std::runtime_error(path + " can't be read");
  ScanInput<float> input;
  input.points = {
      cloud.points.data()->data, cloud.size(), sizeof(pcl::PointXYZ) / sizeof(float)};
  input.viewpoint = cloud.sensor_origin_.head<3>().cast<double>();
  input.viewpoint_known = true; // a scan from one place, which the file knows
  return registration.makeScan(input, 0.05);
}

int
main(int argc, char** argv)
{
  PairRegistration registration;
  std::vector<PairOfScans> pairs;
  const Scan target = read(registration, argv[1]);
  for (int i = 2; i < argc; ++i)
    pairs.push_back({read(registration, argv[i]), target});
  int trusted = 0;
  for (const PairResult& result : registration.alignBatch(pairs)) {
    std::printf("confidence %.2f, %zu inliers\n",
                result.pose.confidence,
                result.pose.inliers.size());
    trusted += result.pose.converged;
  }
  return trusted == argc - 2 ? 0 : 1;
}
