// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Normals as pcl::NormalEstimation defines them: the direction in which a neighbourhood
// is spread least, turned towards the viewpoint; or those that came with the points.

#include "scan/cpu/feature_stages.h"
#include "math/symmetric3.h"
#include "scan/points.h"

#include <algorithm>
#include <cmath>

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

/** \brief What has no direction becomes false. */
bool
normalize(Vec3& vector)
{
  const double length = std::sqrt(dot(vector, vector));
  if (!(length > 0) || !std::isfinite(length))
    return false;
  vector = (1 / length) * vector;
  return true;
}

} // namespace

std::vector<Vec3>
FeatureStages::sumNormals(const PointView& points, const GivenNormals& given) const
{
  if (!given.data)
    return {};
  if (voxel_size_ > 0)
    return voxel_grid_.sumNormals(points, given);
  std::vector<Vec3> normals;
  for (std::size_t i = 0; i < countOf(points); ++i)
    if (isFinite(pointOf(points, i))) {
      const float* n = given.of(indexOf(points, i));
      normals.push_back({n[0], n[1], n[2]});
    }
  return normals;
}

void
FeatureStages::normals(const PointView& points,
                       const GivenNormals& given,
                       double radius,
                       const float viewpoint[3])
{
  constexpr std::size_t FEWEST_NEIGHBORS = 3;
  const std::vector<Vec3> sums = sumNormals(points, given);
  curvatures_.assign(grid_.size(), 0);
  std::vector<char> has_normal(grid_.size(), 0);
  const SurfaceArrays arrays = grid_.arrays();
  const auto set = [&](std::size_t i, Vec3 normal, bool orient) {
    const Vec3 to_sensor{static_cast<double>(viewpoint[0]) - arrays.x[i],
                         static_cast<double>(viewpoint[1]) - arrays.y[i],
                         static_cast<double>(viewpoint[2]) - arrays.z[i]};
    if (orient && dot(to_sensor, normal) < 0)
      normal = -1.0 * normal;
    grid_.setNormal(i,
                    static_cast<float>(normal.x),
                    static_cast<float>(normal.y),
                    static_cast<float>(normal.z));
    has_normal[i] = 1;
  };
  for (std::size_t i = 0; i < grid_.size() && !sums.empty(); ++i)
    if (Vec3 normal = sums[grid_.row(i)]; normalize(normal))
      set(i, normal, given.orient);
  const bool complete =
      std::find(has_normal.begin(), has_normal.end(), 0) == has_normal.end();
  if (complete)
    return;

  forEachPlace(radius, [&](std::size_t i, Neighbors& around) {
    bool wanted = false;
    forEachAt(i, [&](std::size_t j) { wanted |= !has_normal[j]; });
    if (!wanted || around.count < FEWEST_NEIGHBORS)
      return;
    const float point[3] = {arrays.x[i], arrays.y[i], arrays.z[i]};
    const std::size_t padded = padNeighbors(
        around.indices.data(), around.count, static_cast<std::uint32_t>(i));
    float moments[9];
    kernels_.momentSums(arrays, point, around.indices.data(), padded, moments);
    const Symmetric3 spread = covariance(moments, around.count);
    const double smallest = smallestEigenvalue(spread);
    Vec3 normal;
    if (!smallestEigenvector(spread, smallest, normal))
      return;
    const double trace = spread.xx + spread.yy + spread.zz;
    forEachAt(i, [&](std::size_t j) {
      if (has_normal[j])
        return;
      set(j, normal, true);
      curvatures_[j] = static_cast<float>(smallest / trace);
    });
  });
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (!has_normal[i])
      grid_.remove(i);
}

} // namespace cpu
} // namespace pcl_flashreg
