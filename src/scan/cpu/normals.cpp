// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Normals as pcl::NormalEstimation defines them: the direction in which a neighbourhood
// is spread least; or those that came with the points. And where they point to.

#include "scan/cpu/feature_stages.h"
#include "math/symmetric3.h"
#include "scan/points.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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
                       double radius)
{
  constexpr std::size_t FEWEST_NEIGHBORS = 3;
  const std::vector<Vec3> sums = sumNormals(points, given);
  curvatures_.assign(grid_.size(), 0);
  normal_sources_.assign(grid_.size(), NormalSource::None);
  const SurfaceArrays arrays = grid_.arrays();
  const auto set = [&](std::size_t i, const Vec3& normal, NormalSource source) {
    grid_.setNormal(i,
                    static_cast<float>(normal.x),
                    static_cast<float>(normal.y),
                    static_cast<float>(normal.z));
    normal_sources_[i] = source;
  };
  for (std::size_t i = 0; i < grid_.size() && !sums.empty(); ++i)
    if (Vec3 normal = sums[grid_.row(i)]; normalize(normal))
      set(i, normal, NormalSource::Given);
  const auto missing = [this](std::size_t i) {
    return normal_sources_[i] == NormalSource::None;
  };
  bool complete = true;
  for (std::size_t i = 0; i < grid_.size(); ++i)
    complete = complete && !missing(i);
  if (complete)
    return;

  forEachPlace(radius, [&](std::size_t i, Neighbors& around) {
    bool wanted = false;
    forEachAt(i, [&](std::size_t j) { wanted |= missing(j); });
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
      if (!missing(j))
        return;
      set(j, normal, NormalSource::Computed);
      curvatures_[j] = static_cast<float>(smallest / trace);
    });
  });
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (missing(i))
      grid_.remove(i);
}

bool
FeatureStages::hasComputedNormals() const
{
  return std::find(normal_sources_.begin(),
                   normal_sources_.end(),
                   NormalSource::Computed) != normal_sources_.end();
}

void
FeatureStages::turnNormals(const Eigen::Vector3f& viewpoint, bool given_too)
{
  const SurfaceArrays arrays = grid_.arrays();
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const NormalSource source = normal_sources_[i];
    if (source == NormalSource::None || (source == NormalSource::Given && !given_too))
      continue;
    const Eigen::Vector3f n = normalAt(static_cast<std::uint32_t>(i));
    const Vec3 to_sensor{static_cast<double>(viewpoint.x()) - arrays.x[i],
                         static_cast<double>(viewpoint.y()) - arrays.y[i],
                         static_cast<double>(viewpoint.z()) - arrays.z[i]};
    if (dot(to_sensor, {n.x(), n.y(), n.z()}) < 0)
      turnNormal(static_cast<std::uint32_t>(i));
  }
}

std::vector<std::uint32_t>
FeatureStages::computedNormals() const
{
  std::vector<std::uint32_t> keypoints;
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (normal_sources_[i] == NormalSource::Computed)
      keypoints.push_back(static_cast<std::uint32_t>(i));
  return keypoints;
}

Eigen::Vector3f
FeatureStages::pointAt(std::uint32_t keypoint) const
{
  const SurfaceArrays arrays = grid_.arrays();
  return {arrays.x[keypoint], arrays.y[keypoint], arrays.z[keypoint]};
}

Eigen::Vector3f
FeatureStages::normalAt(std::uint32_t keypoint) const
{
  const SurfaceArrays arrays = grid_.arrays();
  return {arrays.nx[keypoint], arrays.ny[keypoint], arrays.nz[keypoint]};
}

void
FeatureStages::turnNormal(std::uint32_t keypoint)
{
  const Eigen::Vector3f normal = normalAt(keypoint);
  grid_.setNormal(keypoint, -normal.x(), -normal.y(), -normal.z());
}

Visibility
FeatureStages::visibility(std::size_t most, double spacing) const
{
  // Share of the smallest eigenvalue: above it lie leaves, cables, edges.
  constexpr float SOLID = 0.05f;
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (!grid_.isRemoved(i))
      places.push_back(static_cast<std::uint32_t>(i));
  // Steps of the golden section, which leave no large gap however many are taken.
  const std::size_t n = places.size();
  auto step = std::max<std::size_t>(1, static_cast<std::size_t>(0.6180339887 * n));
  while (std::gcd(step, n) > 1)
    ++step;
  const SurfaceArrays arrays = grid_.arrays();
  std::vector<SurfaceElement> elements;
  elements.reserve(std::min(most, n));
  for (std::size_t k = 0; k < std::min(most, n); ++k) {
    const std::uint32_t i = places[k * step % n];
    SurfaceElement element;
    element.point = {arrays.x[i], arrays.y[i], arrays.z[i]};
    element.normal = {arrays.nx[i], arrays.ny[i], arrays.nz[i]};
    if (voxel_size_ > 0)
      element.log_count =
          std::log(static_cast<float>(voxel_grid_.countIn(grid_.row(i))));
    element.solid = curvatures_[i] < SOLID;
    elements.push_back(element);
  }
  return Visibility(std::move(elements), n, static_cast<float>(spacing));
}

} // namespace cpu
} // namespace pcl_flashreg
