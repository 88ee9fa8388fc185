// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "made_points.h"

#include <pcl_flashreg/flash_registration.h>

#include <pcl/common/transforms.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <cstdio>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/** \brief A corner of a room, 3 m, with balls of different sizes in it. */
Cloud::Ptr
makeCloud()
{
  Numbers numbers;
  auto cloud = pcl::make_shared<Cloud>();
  for (int i = 0; i < 24000; ++i) {
    Eigen::Vector3d wall = numbers.nextPoint(3.0);
    wall[i % 3] = 0.0;
    cloud->emplace_back(wall.x(), wall.y(), wall.z());
  }
  for (int ball = 0; ball < 12; ++ball) {
    const Eigen::Vector3d center =
        numbers.nextPoint(2.4) + Eigen::Vector3d::Constant(0.3);
    const double radius = 0.15 + 0.25 * numbers.next();
    for (int i = 0; i < 1600; ++i) {
      const Eigen::Vector3d direction =
          numbers.nextPoint(2.0) - Eigen::Vector3d::Ones();
      const Eigen::Vector3d point = center + radius * direction.normalized();
      cloud->emplace_back(point.x(), point.y(), point.z());
    }
  }
  return cloud;
}

/** \brief Aligns the clouds, then searches the target.
 * \return whether all of that came out right */
bool
alignsWith(pcl_flashreg::FrontEnd front_end,
           const Cloud::Ptr& source,
           const Cloud::Ptr& target)
{
  pcl_flashreg::FlashRegistration<pcl::PointXYZ, pcl::PointXYZ> registration;
  registration.setInputSource(source);
  registration.setInputTarget(target);
  registration.setResolution(0.06);
  registration.setFrontEnd(front_end);
  Cloud aligned;
  registration.align(aligned);

  const Eigen::Matrix4d error =
      registration.getFinalTransformation().cast<double>() - truePose().matrix();
  const double fitness = registration.getFitnessScore();
  std::printf("%s: converged %d, error %g, fitness %g\n",
              pcl_flashreg::version(),
              registration.hasConverged(),
              error.norm(),
              fitness);
  return registration.hasConverged() && error.norm() < 0.2 && fitness < 0.01 &&
         registration.getInliers().size() > source->size() / 2 &&
         aligned.size() == source->size();
}

int
main()
{
  const auto source = makeCloud();
  auto target = pcl::make_shared<Cloud>();
  pcl::transformPointCloud(*source, *target, truePose().matrix().cast<float>());
  bool right = alignsWith(pcl_flashreg::FrontEnd::Native, source, target);
  // PCL's libraries are built without AVX: this would crash in there.
#if defined(PCL_NO_PRECOMPILE) || !defined(__AVX__)
  right = right && alignsWith(pcl_flashreg::FrontEnd::Pcl, source, target);
#endif
  return right ? 0 : 1;
}
