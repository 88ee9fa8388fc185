// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pcl_cloud.h"

#include <pcl_flashreg/scan.h>

namespace pcl_flashreg::io {
namespace {

Eigen::Vector3d
shiftOf(const Eigen::Matrix3Xd& xyz)
{
  return singlePrecisionShift(BasicPointView<double>{
      xyz.data(), static_cast<std::size_t>(xyz.cols()), 3, nullptr, 0});
}

} // namespace

bool
needsDoublePrecision(const Eigen::Matrix3Xd& xyz)
{
  return !shiftOf(xyz).isZero(0);
}

ShiftedCloud
toPclCloud(const Eigen::Matrix3Xd& xyz)
{
  ShiftedCloud result;
  result.shift = shiftOf(xyz);
  result.points.reset(new pcl::PointCloud<pcl::PointXYZ>);
  result.points->reserve(static_cast<std::size_t>(xyz.cols()));
  result.points->is_dense = false;
  for (Eigen::Index i = 0; i < xyz.cols(); ++i) {
    const Eigen::Vector3f p = (xyz.col(i) - result.shift).cast<float>();
    result.points->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
  }
  return result;
}

} // namespace pcl_flashreg::io
