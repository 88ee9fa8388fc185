// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Correspondences of your own, of which nine in ten are wrong: to a pose. Needs neither PCL nor
// clouds.

#include <pcl_flashreg/estimator.h>

#include <cmath>
#include <cstdio>
#include <vector>

int
main()
{
  constexpr std::size_t N = 2000;
  std::vector<double> source(3 * N), target(3 * N);
  for (std::size_t i = 0; i < 3 * N; ++i) {
    const auto k = static_cast<double>(i);
    source[i] = 4 * std::fabs(std::sin(12.9898 * (k + 1)));
    target[i] = i / 3 % 10 == 0 ? source[i] + static_cast<double>(i % 3 + 1)
                                : 4 * std::fabs(std::sin(78.233 * k));
  }
  pcl_flashreg::Estimator estimator;
  const pcl_flashreg::Result result = estimator.estimate(
      pcl_flashreg::CorrespondenceView<double>{
          source.data(), target.data(), N, nullptr},
      pcl_flashreg::Parameters::fromResolution(0.05));
  const Eigen::Vector3d shift = result.T_target_source.translation;
  std::printf(
      "%zu of %zu agree, shifted by (%.3f, %.3f, %.3f), confidence %.2f, %.1f ms\n",
      result.inliers.size(),
      N,
      shift.x(),
      shift.y(),
      shift.z(),
      result.confidence,
      result.timings_ms.total);
  return result.converged ? 0 : 1;
}
