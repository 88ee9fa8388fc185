// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "descriptors.h"

#include <pcl_flashreg/pcl_front_end.h>

#include <pcl/features/shot_omp.h>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief Without keypoints of its own: PCL's reference frames are computed at each. */
pcl::PointCloud<pcl::SHOT352>
estimateShot(const detail::PointsXYZ::ConstPtr& points,
             const detail::Normals::ConstPtr& normals,
             double radius)
{
  pcl::PointCloud<pcl::SHOT352> features;
  pcl::SHOTEstimationOMP<pcl::PointXYZ, pcl::Normal, pcl::SHOT352> estimation;
  estimation.setRadiusSearch(radius);
  estimation.setInputCloud(points);
  estimation.setInputNormals(normals);
  estimation.compute(features);
  return features;
}

} // namespace

const std::map<std::string, Descriptors> DESCRIPTORS = {
    {"fpfh", Descriptors::Native},
    {"pcl_fpfh", Descriptors::PclFpfh},
    {"shot", Descriptors::Shot}};

Scan
describeAnew(const Scan& surface, Descriptors descriptors, PairRegistration& maker)
{
  const detail::PointsXYZ::Ptr points(new detail::PointsXYZ);
  const detail::Normals::Ptr normals(new detail::Normals);
  std::vector<double> xyz;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const float *p = surface.points() + 3 * i, *n = surface.normals() + 3 * i;
    points->emplace_back(p[0], p[1], p[2]);
    normals->emplace_back(n[0], n[1], n[2]);
    const Eigen::Vector3d point = surface.point(i);
    xyz.insert(xyz.end(), point.data(), point.data() + 3);
  }
  ScanInput<double> input;
  input.points.data = xyz.data();
  input.points.size = surface.size();
  input.normals = surface.normals();
  input.viewpoint_known = surface.viewpoint().has_value();
  input.viewpoint = surface.viewpoint().value_or(Eigen::Vector3d::Zero());
  const double radius = 5 * surface.spacing();
  if (descriptors == Descriptors::PclFpfh) {
    const auto features = detail::estimateFpfh(points, normals, radius, 0);
    input.features = detail::viewOf(*features);
    return maker.makeScan(input, surface.spacing());
  }
  const auto features = estimateShot(points, normals, radius);
  const std::size_t stride = sizeof(pcl::SHOT352) / sizeof(float);
  input.features = {features.empty() ? nullptr : features[0].descriptor,
                    features.size(),
                    pcl::SHOT352::descriptorSize(),
                    stride};
  return maker.makeScan(input, surface.spacing());
}

} // namespace pcl_flashreg::evaluate
