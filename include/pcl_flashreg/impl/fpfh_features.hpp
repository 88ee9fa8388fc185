// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/fpfh_features.h>
#include <pcl_flashreg/impl/voxel_count.hpp>

#include <pcl/common/point_tests.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_flashreg {
namespace detail {

using PointsXYZ = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Fpfh33 = pcl::PointCloud<pcl::FPFHSignature33>;

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

/** \brief The points as rows of floats: in place, or, where a point type keeps its
 * coordinates apart, a copy. */
template <typename PointT>
class FloatRows {
public:
  explicit FloatRows(const pcl::PointCloud<PointT>& cloud)
  {
    view_.size = cloud.size();
    if (cloud.empty())
      return;
    const PointT& first = cloud[0];
    const bool in_place = sizeof(PointT) % sizeof(float) == 0 &&
                          &first.y == &first.x + 1 && &first.z == &first.x + 2;
    if (in_place) {
      view_.data = &first.x;
      view_.stride = sizeof(PointT) / sizeof(float);
      return;
    }
    copy_.reserve(3 * cloud.size());
    for (const PointT& point : cloud)
      copy_.insert(copy_.end(), {point.x, point.y, point.z});
    view_.data = copy_.data();
  }

  const PointView&
  view() const
  {
    return view_;
  }

private:
  PointView view_;
  std::vector<float> copy_;
};

inline FpfhCloud
toFpfhCloud(const DescribedCloud& described)
{
  FpfhCloud result;
  result.points.reset(new PointsXYZ);
  result.normals.reset(new Normals);
  result.features.reset(new Fpfh33);
  result.points->reserve(described.size);
  result.normals->reserve(described.size);
  for (std::size_t i = 0; i < described.size; ++i) {
    const float* point = &described.points[3 * i];
    const float* normal = &described.normals[3 * i];
    result.points->emplace_back(point[0], point[1], point[2]);
    result.normals->emplace_back(normal[0], normal[1], normal[2]);
    result.normals->back().curvature = described.curvatures[i];
  }
  static_assert(sizeof(pcl::FPFHSignature33) == 33 * sizeof(float));
  result.features->resize(described.size);
  if (described.size > 0)
    std::memcpy((*result.features)[0].histogram,
                described.descriptors.data(),
                described.descriptors.size() * sizeof(float));
  return result;
}

} // namespace detail

template <typename PointT>
FpfhCloud
computeFpfh(const pcl::PointCloud<PointT>& cloud,
            const pcl::Indices& indices,
            double resolution,
            unsigned num_threads,
            FpfhTimings* timings)
{
  const detail::FloatRows<PointT> rows(cloud);
  const std::vector<std::int32_t> selected(indices.begin(), indices.end());
  PointView view = rows.view();
  if (!indices.empty()) {
    view.indices = selected.data();
    view.index_count = selected.size();
  }
  FeatureParameters parameters = FeatureParameters::fromResolution(resolution);
  for (int axis = 0; axis < 3; ++axis)
    parameters.viewpoint[axis] = cloud.sensor_origin_[axis];
  FeatureTimings spent;
  const FpfhCloud result = detail::toFpfhCloud(
      FeatureExtractor(num_threads).describe(view, parameters, &spent));
  result.points->header = cloud.header;
  result.points->sensor_origin_ = cloud.sensor_origin_;
  result.points->sensor_orientation_ = cloud.sensor_orientation_;
  if (timings) {
    timings->voxel_grid = spent.voxel_grid;
    timings->normals = spent.neighbor_grid + spent.normals;
    timings->features = spent.point_histograms + spent.feature_histograms;
  }
  return result;
}

template <typename PointT>
double
estimateResolution(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  const detail::VoxelCount voxels(*detail::finitePoints(cloud, indices));
  const double quarter = 0.25 * static_cast<double>(voxels.distinctPoints());
  return detail::roundToPreferredNumber(
      voxels.sizeFor(std::max(2.0, std::min(2500.0, quarter))));
}

template <typename PointT>
double
estimateVoxelSize(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  // Centroids of pcl::VoxelGrid on surfaces occupy this share of the voxels of a grid
  // of the same size that is shifted against it.
  constexpr double occupied_share = 0.65;
  const detail::VoxelCount voxels(*detail::finitePoints(cloud, indices));
  const auto points = static_cast<double>(voxels.distinctPoints());
  return voxels.sizeFor(std::max(2.0, occupied_share * points));
}

} // namespace pcl_flashreg
