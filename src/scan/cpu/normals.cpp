// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Normals as pcl::NormalEstimation defines them: the direction in which a neighbourhood
// is spread least, turned towards the viewpoint.

#include "scan/cpu/feature_stages.h"
#include "math/symmetric3.h"

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Covariance from sums of differences with one of the points. */
Symmetric3
covariance(const float sums[9], std::size_t count)
{
  const double scale = 1.0 / static_cast<double>(count);
  const double x = scale * sums[0], y = scale * sums[1], z = scale * sums[2];
  return {scale * sums[3] - x * x,
          scale * sums[4] - x * y,
          scale * sums[5] - x * z,
          scale * sums[6] - y * y,
          scale * sums[7] - y * z,
          scale * sums[8] - z * z};
}

} // namespace

void
FeatureStages::normals(double radius, const float viewpoint[3])
{
  constexpr std::size_t FEWEST_NEIGHBORS = 3;
  curvatures_.resize(grid_.size());
  std::vector<char> has_normal(grid_.size(), 0);
  const SurfaceArrays arrays = grid_.arrays();
  forEachPoint(radius, [&](std::size_t i, Neighbors& around) {
    if (around.count < FEWEST_NEIGHBORS)
      return;
    const float point[3] = {arrays.x[i], arrays.y[i], arrays.z[i]};
    const std::size_t padded = padNeighbors(
        around.indices.data(), around.count, static_cast<std::uint32_t>(i));
    float sums[9];
    kernels_.momentSums(arrays, point, around.indices.data(), padded, sums);
    const Symmetric3 spread = covariance(sums, around.count);
    const double smallest = smallestEigenvalue(spread);
    Vec3 normal;
    if (!smallestEigenvector(spread, smallest, normal))
      return;
    const Vec3 to_sensor{static_cast<double>(viewpoint[0]) - point[0],
                         static_cast<double>(viewpoint[1]) - point[1],
                         static_cast<double>(viewpoint[2]) - point[2]};
    if (dot(to_sensor, normal) < 0)
      normal = -1.0 * normal;
    grid_.setNormal(i,
                    static_cast<float>(normal.x),
                    static_cast<float>(normal.y),
                    static_cast<float>(normal.z));
    curvatures_[i] = static_cast<float>(smallest / (spread.xx + spread.yy + spread.zz));
    has_normal[i] = 1;
  });
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (!has_normal[i])
      grid_.remove(i);
}

} // namespace cpu
} // namespace pcl_flashreg
