// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Geo-referenced clouds: eastings and northings of hundreds of kilometres, which single precision
// would round to centimetres. Keep them in double precision; the pose is, too.
//
//   example_geo_referenced source.pcd target.pcd

#include <pcl_flashreg/pair_registration.h>

#include <pcl/io/pcd_io.h>

#include <cstdio>
#include <vector>

using namespace pcl_flashreg;

static std::vector<double>
inUtm(const pcl::PointCloud<pcl::PointXYZ>& cloud)
{
  std::vector<double> xyz;
  for (const pcl::PointXYZ& p : cloud)
    for (const double coordinate : {p.x + 691000.25, p.y + 5336000.75, p.z + 519.5})
      xyz.push_back(coordinate);
  return xyz;
}

int
main(int argc, char** argv)
{
  pcl::PointCloud<pcl::PointXYZ> a, b;
  if (argc < 3 || pcl::io::loadPCDFile(argv[1], a) < 0 ||
      pcl::io::loadPCDFile(argv[2], b) < 0)
    return 2;
  const std::vector<double> source = inUtm(a), target = inUtm(b);
  ScanInput<double> from, to;
  from.points = {source.data(), source.size() / 3};
  to.points = {target.data(), target.size() / 3};
  PairOptions options;
  options.resolution = 0.05;
  const Result pose = PairRegistration().align(from, to, options).pose;
  const Eigen::Vector3d first = pose.T_target_source.toIsometry() *
                                Eigen::Vector3d(source[0], source[1], source[2]);
  std::printf("the first point: %.3f E, %.3f N, %.3f m; confidence %.2f\n",
              first.x(),
              first.y(),
              first.z(),
              pose.confidence);
  return pose.converged ? 0 : 1;
}
