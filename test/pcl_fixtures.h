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

#include "support/made_correspondences.h"

namespace pcl_flashreg {
namespace made {

/** \brief Points on the surfaces of a room corner of 3 m x 2.4 m x 2 m with furniture,
 * drawn at random; different seeds sample the same room. Metres. */
class Room {
public:
  Room(std::uint64_t seed, double points_per_square_metre, double noise)
      : random_(seed), density_(points_per_square_metre), noise_(noise)
  {
    using Eigen::Vector3d;
    rectangle({0, 0, 0}, {3, 0, 0}, {0, 2.4, 0});
    rectangle({0, 0, 0}, {3, 0, 0}, {0, 0, 2});
    rectangle({0, 0, 0}, {0, 2.4, 0}, {0, 0, 2});
    box({0.2, 0.1, 0}, {0.9, 0.45, 1.5}, 0);
    box({1.5, 0.5, 0}, {1.1, 0.6, 0.72}, 0.5);
    box({1.75, 0.75, 0.72}, {0.35, 0.25, 0.4}, 0.9);
    box({0.5, 1.5, 0}, {0.5, 0.5, 0.45}, -0.3);
    box({2.3, 1.7, 0}, {0.4, 0.3, 0.9}, 1.1);
    cylinder({1.4, 1.9, 0}, 0.2, 0.8);
    cylinder({0.45, 0.3, 1.5}, 0.13, 0.3);
    cylinder({2.7, 0.3, 0}, 0.1, 1.6);
  }

  const std::vector<Eigen::Vector3d>&
  points() const
  {
    return points_;
  }

private:
  void
  add(const Eigen::Vector3d& point)
  {
    const double x = random_.normal(), y = random_.normal(), z = random_.normal();
    points_.push_back(point + noise_ * Eigen::Vector3d(x, y, z));
  }

  int
  countFor(double area) const
  {
    return static_cast<int>(area * density_);
  }

  void
  rectangle(const Eigen::Vector3d& corner,
            const Eigen::Vector3d& a,
            const Eigen::Vector3d& b)
  {
    for (int i = countFor(a.cross(b).norm()); i > 0; --i) {
      const double u = random_.uniform(0, 1), v = random_.uniform(0, 1);
      add(corner + u * a + v * b);
    }
  }

  /** \brief The top and the four sides, turned by yaw about the vertical at corner. */
  void
  box(const Eigen::Vector3d& corner, const Eigen::Vector3d& size, double yaw)
  {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Vector3d a = turn.col(0) * size.x(), b = turn.col(1) * size.y();
    const Eigen::Vector3d c = turn.col(2) * size.z();
    rectangle(corner + c, a, b);
    rectangle(corner, a, c);
    rectangle(corner, b, c);
    rectangle(corner + a, b, c);
    rectangle(corner + b, a, c);
  }

  void
  cylinder(const Eigen::Vector3d& foot, double radius, double height)
  {
    const double circle = 2 * 3.14159265358979323846;
    for (int i = countFor(circle * radius * height); i > 0; --i) {
      const double angle = random_.uniform(0, circle), z = random_.uniform(0, height);
      add(foot +
          Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z));
    }
    for (int i = countFor(circle / 2 * radius * radius); i > 0; --i) {
      const double angle = random_.uniform(0, circle);
      const double r = radius * std::sqrt(random_.uniform(0, 1));
      add(foot + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), height));
    }
  }

  Random random_;
  double density_;
  double noise_;
  std::vector<Eigen::Vector3d> points_;
};

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
