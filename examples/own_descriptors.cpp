// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Keypoints and descriptors of your own (of a network, say), N x D floats a side. Here the
// descriptor of a point tells its distances to four places, which a rigid motion keeps.

#include <pcl_flashreg/pair_registration.h>

#include <cmath>
#include <cstdio>
#include <vector>

using namespace pcl_flashreg;

constexpr std::size_t N = 500, D = 4;

/** \brief Descriptors of points, by four of them. */
static std::vector<float>
describe(const std::vector<float>& xyz)
{
  std::vector<float> values(N * D);
  for (std::size_t i = 0; i < N; ++i)
    for (std::size_t d = 0; d < D; ++d)
      values[D * i + d] = std::hypot(xyz[3 * i] - xyz[3 * d],
                                     xyz[3 * i + 1] - xyz[3 * d + 1],
                                     xyz[3 * i + 2] - xyz[3 * d + 2]);
  return values;
}

int
main()
{
  std::vector<float> source(3 * N), target(3 * N);
  for (std::size_t i = 0; i < N; ++i) { // a wavy floor; the target turned by 90 degrees
    const float x = 3 * std::fabs(std::sin(12.9898f * static_cast<float>(i)));
    const float y = 3 * std::fabs(std::sin(78.233f * static_cast<float>(i)));
    const float z = 0.3f * std::sin(3 * x) * std::cos(2 * y);
    source[3 * i] = x, source[3 * i + 1] = y, source[3 * i + 2] = z;
    target[3 * i] = -y + 1, target[3 * i + 1] = x + 2, target[3 * i + 2] = z;
  }
  const std::vector<float> source_values = describe(source),
                           target_values = describe(target);
  ScanInput<float> from, to;
  from.points = {source.data(), N};
  from.features = {source_values.data(), N, D, D};
  to.points = {target.data(), N};
  to.features = {target_values.data(), N, D, D};
  PairOptions options;
  options.resolution = 0.1; // the spacing of the keypoints
  const PairResult result = PairRegistration().align(from, to, options);
  const Eigen::Vector3d shift = result.pose.T_target_source.translation;
  std::printf("%zu matches, %zu inliers, shifted by (%.2f, %.2f, %.2f)\n",
              result.matches.size(),
              result.pose.inliers.size(),
              shift.x(),
              shift.y(),
              shift.z());
  return result.pose.converged ? 0 : 1;
}
