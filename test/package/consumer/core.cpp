// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "made_points.h"

#include <pcl_flashreg/pair_registration.h>

#include <cstdio>
#include <vector>

int
main()
{
  // 400 correspondences in a 3 m cube, every fourth of them right.
  Numbers numbers;
  std::vector<double> source;
  std::vector<double> target;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d s = numbers.nextPoint(3.0);
    const Eigen::Vector3d wrong = numbers.nextPoint(3.0);
    const Eigen::Vector3d t = i % 4 == 0 ? truePose() * s : wrong;
    source.insert(source.end(), {s.x(), s.y(), s.z()});
    target.insert(target.end(), {t.x(), t.y(), t.z()});
  }

  pcl_flashreg::CorrespondenceView<double> correspondences;
  correspondences.source_xyz = source.data();
  correspondences.target_xyz = target.data();
  correspondences.size = source.size() / 3;
  pcl_flashreg::Estimator estimator;
  const auto result = estimator.estimate(correspondences);

  const Eigen::Matrix4d error =
      result.T_target_source.toMatrix<double>() - truePose().matrix();
  std::printf("%s: converged %d, %zu inliers, error %g\n",
              pcl_flashreg::version(),
              result.converged,
              result.inliers.size(),
              error.norm());

  // The same through the whole way, and a scan through a file's bytes.
  pcl_flashreg::PairRegistration registration;
  pcl_flashreg::ScanInput<double> nothing, cloud;
  const auto pair = registration.align(nothing, nothing, correspondences);
  cloud.points.data = source.data();
  cloud.points.size = source.size() / 3;
  const auto scan =
      registration.makeScan(cloud, 0.5, pcl_flashreg::ScanContent::Surface);
  const auto loaded = pcl_flashreg::Scan::deserialize(scan.serialize());
  const bool right = pair.pose.inliers.size() >= 100 && scan.size() > 50 &&
                     loaded.size() == scan.size();
  return right && result.converged && error.norm() < 1e-3 ? 0 : 1;
}
