// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "truth.h"

#include "../../io/cloud_io.h"
#include "../../io/file.h"
#include "../../io/transform_io.h"
#include "../../io/hash.h"

#include <pcl/filters/approximate_voxel_grid.h>
#include <pcl/registration/icp.h>

#include <filesystem>
#include <optional>

namespace pcl_flashreg::evaluate {
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;

Points::Ptr
thinned(const Eigen::Matrix3Xd& xyz)
{
  Points::Ptr all(new Points), thin(new Points);
  for (const auto& p : xyz.colwise())
    if (p.allFinite())
      all->emplace_back(static_cast<float>(p.x()),
                        static_cast<float>(p.y()),
                        static_cast<float>(p.z()));
  pcl::ApproximateVoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(0.05f, 0.05f, 0.05f);
  grid.setInputCloud(all);
  grid.filter(*thin);
  return thin;
}

/** \brief A pose behind a line with its checksum; nothing if it is not as it was written. */
std::optional<RigidTransform>
load(const std::string& path)
{
  if (!std::filesystem::is_regular_file(path))
    return std::nullopt;
  try {
    const std::string text = io::readFile(path);
    const std::size_t end = text.find('\n');
    const std::string pose = text.substr(std::min(text.size(), end + 1));
    if (text.substr(0, end) == "# " + io::toHex(io::hashOf(pose)))
      return io::parseTransform(pose);
  }
  catch (const io::InputError&) {
  }
  return std::nullopt;
}

} // namespace

RigidTransform
refineTruth(const Eigen::Matrix3Xd& source,
            const Eigen::Matrix3Xd& target,
            const RigidTransform& T_target_source)
{
  pcl::IterativeClosestPoint<pcl::PointXYZ, pcl::PointXYZ, double> icp;
  icp.setInputSource(thinned(source));
  icp.setInputTarget(thinned(target));
  icp.setMaxCorrespondenceDistance(0.2);
  icp.setMaximumIterations(200);
  icp.setTransformationEpsilon(1e-8);
  Points aligned;
  icp.align(aligned, T_target_source.toMatrix<double>());
  if (!icp.hasConverged())
    return T_target_source;
  const Eigen::Matrix4d T = icp.getFinalTransformation();
  RigidTransform refined;
  refined.rotation =
      Eigen::Quaterniond(T.topLeftCorner<3, 3>()).normalized().toRotationMatrix();
  refined.translation = T.topRightCorner<3, 1>();
  return refined;
}

RigidTransform
TruthStore::get(const Pair& pair) const
{
  if (!pair.refine_truth)
    return pair.T_target_source;
  const std::string source = root_ + "/" + pair.source;
  const std::string target = root_ + "/" + pair.target;
  std::string cached;
  if (!cache_folder_.empty()) {
    const std::string key = io::toHex(io::hashOf(io::readFile(source))) +
                            io::toHex(io::hashOf(io::readFile(target))) +
                            io::formatTransform(pair.T_target_source);
    cached = cache_folder_ + "/" + io::toHex(io::hashOf(key)) + ".pose";
    if (const auto pose = load(cached))
      return *pose;
  }
  const auto points = [&](const std::string& path) {
    return io::coordinates(io::readCloud(path, bin_fields_));
  };
  const RigidTransform refined =
      refineTruth(points(source), points(target), pair.T_target_source);
  if (!cached.empty()) {
    const std::string pose = io::formatTransform(refined);
    io::writeFile(cached, "# " + io::toHex(io::hashOf(pose)) + '\n' + pose);
  }
  return refined;
}

} // namespace pcl_flashreg::evaluate
