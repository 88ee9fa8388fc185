// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>
#include <pcl_flashreg/pcl_front_end.h>

#include <pcl/common/point_tests.h>
#include <pcl/features/fpfh_omp.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief The finite ones of the points that the indices name (all, if empty). */
template <typename PointT>
PointsXYZ::Ptr
finitePoints(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  PointsXYZ::Ptr points(new PointsXYZ);
  points->header = cloud.header;
  points->sensor_origin_ = cloud.sensor_origin_;
  points->sensor_orientation_ = cloud.sensor_orientation_;
  const auto append = [&points](const PointT& point) {
    if (pcl::isXYZFinite(point))
      points->push_back(pcl::PointXYZ(point.x, point.y, point.z));
  };
  if (indices.empty())
    for (const PointT& point : cloud)
      append(point);
  for (const auto index : indices) {
    if (static_cast<std::size_t>(index) >= cloud.size())
      throw std::invalid_argument("index " + std::to_string(index) +
                                  " is not one of a cloud of " +
                                  std::to_string(cloud.size()) + " points");
    append(cloud[index]);
  }
  return points;
}

/** \brief pcl::VoxelGrid numbers voxels with 32 bits, and returns the cloud unfiltered,
 * with a warning only, where these don't suffice; so that is checked beforehand.
 * \throws std::invalid_argument */
inline void
checkVoxelGrid(const PointsXYZ& points, double resolution)
{
  if (!(resolution > 0) || !std::isfinite(resolution))
    throw std::invalid_argument("the resolution is " + toText(resolution) +
                                ", it must be > 0 and finite");
  double voxels = 1;
  bool fits = true;
  for (int axis = 0; axis < 3; ++axis) {
    const auto bounds = std::minmax_element(
        points.begin(), points.end(), [axis](const auto& a, const auto& b) {
          return a.data[axis] < b.data[axis];
        });
    const double low = std::floor(bounds.first->data[axis] / resolution);
    const double high = std::floor(bounds.second->data[axis] / resolution);
    voxels *= high - low + 1;
    fits &= std::max(std::abs(low), std::abs(high)) < std::numeric_limits<int>::max();
  }
  // One voxel an axis to spare: PCL divides in single precision.
  if (!fits || voxels >= 0.5 * std::numeric_limits<int>::max())
    throw std::invalid_argument("the resolution " + toText(resolution) +
                                " is too small for the extent of the cloud: more "
                                "voxels than 32 bits can number");
}

/** \brief One point a voxel, the centroid of those in it. */
inline PointsXYZ::Ptr
downsample(const PointsXYZ::ConstPtr& points, double resolution)
{
  PointsXYZ::Ptr keypoints(new PointsXYZ);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  const auto leaf = static_cast<float>(resolution);
  grid.setLeafSize(leaf, leaf, leaf);
  grid.setInputCloud(points);
  grid.filter(*keypoints);
  return keypoints;
}

inline Normals::Ptr
estimateNormals(const PointsXYZ::ConstPtr& points, double radius, unsigned num_threads)
{
  Normals::Ptr normals(new Normals);
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(num_threads);
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setRadiusSearch(radius);
  estimation.setInputCloud(points);
  const auto& origin = points->sensor_origin_;
  estimation.setViewPoint(origin.x(), origin.y(), origin.z());
  estimation.compute(*normals);
  return normals;
}

inline Fpfh33::Ptr
estimateFpfh(const PointsXYZ::ConstPtr& points,
             const Normals::ConstPtr& normals,
             double radius,
             unsigned num_threads)
{
  Fpfh33::Ptr features(new Fpfh33);
  pcl::FPFHEstimationOMP<pcl::PointXYZ, pcl::Normal, pcl::FPFHSignature33> estimation(
      num_threads);
  estimation.setSearchMethod(
      pcl::search::KdTree<pcl::PointXYZ>::Ptr(new pcl::search::KdTree<pcl::PointXYZ>));
  estimation.setRadiusSearch(radius);
  estimation.setInputCloud(points);
  estimation.setInputNormals(normals);
  estimation.compute(*features);
  return features;
}

/** \brief Keeps the elements for whose index the test is true. */
template <typename ElementT, typename Test>
void
keepIf(pcl::PointCloud<ElementT>& elements, Test test)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i)
    if (test(i))
      elements[kept++] = elements[i];
  elements.resize(kept);
}

inline bool
isFiniteFpfh(const pcl::FPFHSignature33& feature)
{
  return std::all_of(std::begin(feature.histogram),
                     std::end(feature.histogram),
                     [](float value) { return std::isfinite(value); });
}

/** \param[in] points finite */
inline FpfhCloud
describeWithPcl(const PointsXYZ::Ptr& points,
                double resolution,
                unsigned num_threads,
                FpfhTimings& timings)
{
  FpfhCloud result;
  result.points = points;
  result.normals.reset(new Normals);
  result.features.reset(new Fpfh33);
  if (points->empty())
    return result;
  checkVoxelGrid(*points, resolution);
  const auto keep = [&result](const std::vector<bool>& wanted) {
    const auto is_wanted = [&wanted](std::size_t i) { return wanted[i]; };
    keepIf(*result.points, is_wanted);
    keepIf(*result.normals, is_wanted);
    keepIf(*result.features, is_wanted);
  };

  const Stopwatch voxel_grid;
  result.points = downsample(points, resolution);
  timings.voxel_grid = voxel_grid.milliseconds();

  const Stopwatch normal_estimation;
  result.normals = estimateNormals(result.points, 2 * resolution, num_threads);
  std::vector<bool> finite;
  for (const auto& normal : *result.normals)
    finite.push_back(pcl::isNormalFinite(normal));
  keep(finite);
  timings.normals = normal_estimation.milliseconds();
  if (result.points->empty())
    return result;

  const Stopwatch description;
  result.features =
      estimateFpfh(result.points, result.normals, 5 * resolution, num_threads);
  finite.clear();
  for (const auto& feature : *result.features)
    finite.push_back(isFiniteFpfh(feature));
  keep(finite);
  timings.features = description.milliseconds();
  return result;
}

} // namespace detail

template <typename PointT>
FpfhCloud
computeFpfhWithPcl(const pcl::PointCloud<PointT>& cloud,
                   const pcl::Indices& indices,
                   double resolution,
                   unsigned num_threads,
                   FpfhTimings* timings)
{
  FpfhTimings spent;
  FpfhCloud result = detail::describeWithPcl(
      detail::finitePoints(cloud, indices), resolution, num_threads, spent);
  if (timings)
    *timings = spent;
  return result;
}

} // namespace pcl_flashreg
