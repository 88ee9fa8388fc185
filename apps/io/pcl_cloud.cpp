// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pcl_cloud.h"

#include <Eigen/Geometry>

#include <limits>

namespace pcl_flashreg::io {
namespace {

Eigen::AlignedBox3d
boundsOf(const Eigen::Matrix3Xd& xyz)
{
  Eigen::AlignedBox3d box;
  for (Eigen::Index i = 0; i < xyz.cols(); ++i)
    if (xyz.col(i).allFinite())
      box.extend(xyz.col(i));
  return box;
}

bool
isFarFromOrigin(const Eigen::AlignedBox3d& box)
{
  constexpr double float_step = std::numeric_limits<float>::epsilon();
  constexpr double tolerable = 1e-5;
  if (box.isEmpty())
    return false;
  const double farthest =
      box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  return farthest * float_step > tolerable * box.sizes().maxCoeff();
}

} // namespace

bool
needsDoublePrecision(const Eigen::Matrix3Xd& xyz)
{
  return isFarFromOrigin(boundsOf(xyz));
}

ShiftedCloud
toPclCloud(const Eigen::Matrix3Xd& xyz)
{
  ShiftedCloud result;
  const Eigen::AlignedBox3d box = boundsOf(xyz);
  if (isFarFromOrigin(box))
    result.shift = box.center();
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
