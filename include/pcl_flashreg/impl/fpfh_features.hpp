// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>
#include <pcl_flashreg/resolution.h>
#include <pcl_flashreg/scan.h>

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

inline FeatureView
viewOf(const Fpfh33& features)
{
  constexpr std::size_t stride = sizeof(pcl::FPFHSignature33) / sizeof(float);
  return {features.empty() ? nullptr : features[0].histogram,
          features.size(),
          pcl::FPFHSignature33::descriptorSize(),
          stride};
}

/** \brief Keypoints of a DescribedCloud or a Scan, row by row. */
inline FpfhCloud
toFpfhCloud(std::size_t size,
            const float* points,
            const float* normals,
            const float* curvatures,
            const float* descriptors)
{
  FpfhCloud result;
  result.points.reset(new PointsXYZ);
  result.normals.reset(new Normals);
  result.features.reset(new Fpfh33);
  result.points->reserve(size);
  result.normals->reserve(size);
  for (std::size_t i = 0; i < size; ++i) {
    const float* point = points + 3 * i;
    const float* normal = normals + 3 * i;
    result.points->emplace_back(point[0], point[1], point[2]);
    result.normals->emplace_back(normal[0], normal[1], normal[2]);
    result.normals->back().curvature = curvatures[i];
  }
  static_assert(sizeof(pcl::FPFHSignature33) == 33 * sizeof(float));
  result.features->resize(size);
  if (size > 0)
    std::memcpy((*result.features)[0].histogram,
                descriptors,
                size * sizeof(pcl::FPFHSignature33));
  return result;
}

/** \brief Relative to Scan::shift(). */
inline FpfhCloud
toFpfhCloud(const Scan& scan)
{
  return toFpfhCloud(scan.size(),
                     scan.points(),
                     scan.normals(),
                     scan.curvatures(),
                     scan.features().data);
}

/** \brief Puts keypoints in the place of the cloud that they come from; they must stay. */
inline void
takeKeypoints(const FpfhCloud& fpfh, ScanInput<float>& input)
{
  input.points = PointView();
  input.normals = nullptr;
  input.features = viewOf(*fpfh.features);
  if (fpfh.points->empty())
    return;
  constexpr std::size_t point_floats = sizeof(pcl::PointXYZ) / sizeof(float);
  input.points = {
      (*fpfh.points)[0].data, fpfh.points->size(), point_floats, nullptr, 0};
  input.normals = (*fpfh.normals)[0].normal;
  input.normal_stride = sizeof(pcl::Normal) / sizeof(float);
}

inline FpfhTimings
toFpfhTimings(const FeatureTimings& spent)
{
  FpfhTimings timings;
  timings.voxel_grid = spent.voxel_grid;
  timings.normals = spent.neighbor_grid + spent.normals;
  timings.features = spent.point_histograms + spent.feature_histograms;
  return timings;
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
  const DescribedCloud described = extractor.describe(rows.view(), parameters, &spent);
  const FpfhCloud result = detail::toFpfhCloud(described.size,
                                               described.points.data(),
                                               described.normals.data(),
                                               described.curvatures.data(),
                                               described.descriptors.data());
  result.points->header = cloud.header;
  result.points->sensor_origin_ = cloud.sensor_origin_;
  result.points->sensor_orientation_ = cloud.sensor_orientation_;
  if (timings)
    *timings = detail::toFpfhTimings(spent);
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
