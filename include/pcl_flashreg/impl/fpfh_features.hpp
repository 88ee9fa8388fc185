// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>
#include <pcl_flashreg/resolution.h>

#include <cstdint>
#include <cstring>
#include <vector>

namespace pcl_flashreg {
namespace detail {

using PointsXYZ = pcl::PointCloud<pcl::PointXYZ>;
using Normals = pcl::PointCloud<pcl::Normal>;
using Fpfh33 = pcl::PointCloud<pcl::FPFHSignature33>;

/** \brief The points that the indices name (all, if empty) as rows of floats: in place, or,
 * where a point type keeps its coordinates apart, a copy. */
template <typename PointT>
class FloatRows {
public:
  FloatRows(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
      : indices_(indices.begin(), indices.end())
  {
    view_.size = cloud.size();
    view_.indices = indices_.empty() ? nullptr : indices_.data();
    view_.index_count = indices_.size();
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
  std::vector<std::int32_t> indices_;
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
            FeatureExtractor& extractor,
            FpfhTimings* timings)
{
  const detail::FloatRows<PointT> rows(cloud, indices);
  FeatureParameters parameters = FeatureParameters::fromResolution(resolution);
  for (int axis = 0; axis < 3; ++axis)
    parameters.viewpoint[axis] = cloud.sensor_origin_[axis];
  FeatureTimings spent;
  const FpfhCloud result =
      detail::toFpfhCloud(extractor.describe(rows.view(), parameters, &spent));
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
FpfhCloud
computeFpfh(const pcl::PointCloud<PointT>& cloud,
            const pcl::Indices& indices,
            double resolution,
            unsigned num_threads,
            FpfhTimings* timings)
{
  FeatureExtractor extractor(num_threads);
  return computeFpfh(cloud, indices, resolution, extractor, timings);
}

template <typename PointT>
double
estimateResolution(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  return estimateResolution(detail::FloatRows<PointT>(cloud, indices).view());
}

template <typename PointT>
double
estimateVoxelSize(const pcl::PointCloud<PointT>& cloud, const pcl::Indices& indices)
{
  return estimateVoxelSize(detail::FloatRows<PointT>(cloud, indices).view());
}

} // namespace pcl_flashreg
