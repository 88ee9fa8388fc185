// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl/console/print.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/made_room.h"

namespace pcl_flashreg {
namespace made {

/** \brief Voxel size that suits the clouds of RoomPair. */
constexpr double room_resolution = 0.1;

/** \brief A pose far from the identity. */
inline Eigen::Isometry3d
roomPose()
{
  Eigen::Isometry3d T_target_source = Eigen::Isometry3d::Identity();
  T_target_source.rotate(
      Eigen::AngleAxisd(2.1, Eigen::Vector3d(0.3, -0.5, 0.9).normalized()));
  T_target_source.pretranslate(Eigen::Vector3d(4, -3, 1.5));
  return T_target_source;
}

/** \brief Two samples of the room, each with a part of it that the other lacks, and
 * with the sensor at the same place in the room. */
template <typename PointSource, typename PointTarget>
struct RoomPair {
  typename pcl::PointCloud<PointSource>::Ptr source{new pcl::PointCloud<PointSource>};
  typename pcl::PointCloud<PointTarget>::Ptr target{new pcl::PointCloud<PointTarget>};
  Eigen::Isometry3d T_target_source = roomPose();

  explicit RoomPair(double points_per_square_metre = 400, std::uint64_t seed = 1)
  {
    const Eigen::Isometry3d T_source_target = T_target_source.inverse();
    const Room seen_by_source(seed, points_per_square_metre, 0.004);
    const Room seen_by_target(seed + 1000, points_per_square_metre, 0.004);
    for (const auto& point : seen_by_source.points())
      if (point.x() < 2.5)
        source->push_back(toPoint<PointSource>(T_source_target * point));
    for (const auto& point : seen_by_target.points())
      if (point.x() > 0.3)
        target->push_back(toPoint<PointTarget>(point));
    const Eigen::Vector3d sensor(1.6, 2.0, 1.8);
    source->sensor_origin_.template head<3>() =
        (T_source_target * sensor).template cast<float>();
    target->sensor_origin_.template head<3>() = sensor.template cast<float>();
  }

  template <typename PointT>
  static PointT
  toPoint(const Eigen::Vector3d& xyz)
  {
    PointT point;
    point.getVector3fMap() = xyz.cast<float>();
    return point;
  }
};

using RoomPairXYZ = RoomPair<pcl::PointXYZ, pcl::PointXYZ>;

/** \brief How far an estimate moves the middle of the room from where it belongs. */
inline double
positionError(const Eigen::Matrix4f& estimate, const Eigen::Isometry3d& truth)
{
  const Eigen::Vector3d middle = roomPose().inverse() * Eigen::Vector3d(1.5, 1.2, 0.6);
  const Eigen::Matrix4d pose = estimate.cast<double>();
  return (pose * middle.homogeneous() - (truth * middle).homogeneous()).norm();
}

inline double
rotationError(const Eigen::Matrix4f& estimate, const Eigen::Isometry3d& truth)
{
  const Eigen::Matrix3d rotation = estimate.topLeftCorner<3, 3>().cast<double>();
  return rotationError(rotation, truth.rotation());
}

/** \brief Fails where the pose is further off than what descriptors of voxels of
 * room_resolution allow. */
inline void
expectPose(const Eigen::Matrix4f& estimate, const Eigen::Isometry3d& truth)
{
  EXPECT_LT(rotationError(estimate, truth), 2.0);
  EXPECT_LT(positionError(estimate, truth), 0.05);
}

/** \brief Keeps PCL from printing errors that a test provokes. */
class Silence {
public:
  Silence() : level_(pcl::console::getVerbosityLevel())
  {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~Silence()
  {
    pcl::console::setVerbosityLevel(level_);
  }
  Silence(const Silence&) = delete;
  Silence&
  operator=(const Silence&) = delete;

private:
  pcl::console::VERBOSITY_LEVEL level_;
};

/** \brief Sets a point to not-a-number while is_dense goes on saying that there is
 * none. */
template <typename PointT>
void
spoil(pcl::PointCloud<PointT>& cloud, std::size_t index)
{
  cloud[index].x = std::numeric_limits<float>::quiet_NaN();
  cloud.is_dense = true;
}

} // namespace made
} // namespace pcl_flashreg
