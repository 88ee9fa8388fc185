// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/cpu/feature_stages.h"

#include "scan/points.h"

#include <limits>

namespace pcl_flashreg {
namespace cpu {

void
FeatureStages::voxelGrid(const PointView& points, double voxel_size)
{
  voxel_size_ = voxel_size;
  Bounds bounds;
  std::size_t finite = 0;
  const std::size_t count = countOf(points);
  for (std::size_t i = 0; i < count; ++i) {
    const float* point = pointOf(points, i);
    if (!isFinite(point))
      continue;
    bounds.add(point);
    ++finite;
  }
  keypoints_.clear();
  if (finite == 0)
    return;
  if (voxel_size > 0) {
    voxel_grid_.run(points, bounds, static_cast<float>(voxel_size), pool_, keypoints_);
    return;
  }
  keypoints_.reserve(3 * finite);
  for (std::size_t i = 0; i < count; ++i) {
    const float* point = pointOf(points, i);
    if (isFinite(point))
      keypoints_.insert(keypoints_.end(), point, point + 3);
  }
}

void
FeatureStages::neighborGrid(double radius)
{
  grid_.build(keypoints_, radius);
  equal_ = voxel_size_ > 0 ? detail::EqualRows()
                           : detail::EqualRows(grid_.size(), 3, [this](std::size_t i) {
                               return &keypoints_[3 * std::size_t{grid_.row(i)}];
                             });
}

void
FeatureStages::findPlaces()
{
  places_.clear();
  places_.reserve(grid_.size());
  if (equal_.allDiffer()) {
    for (std::size_t i = 0; i < grid_.size(); ++i)
      if (!grid_.isRemoved(i))
        places_.push_back(i);
    return;
  }
  for (std::uint32_t i : equal_.firsts()) {
    while (i != detail::EqualRows::NONE && grid_.isRemoved(i))
      i = equal_.next(i);
    if (i != detail::EqualRows::NONE)
      places_.push_back(i);
  }
}

DescribedCloud
FeatureStages::takeResult(ScanContent content, bool every_keypoint)
{
  // Where in the grid each keypoint stands that is still there.
  constexpr std::uint32_t GONE = 0xFFFFFFFF;
  constexpr float NONE = std::numeric_limits<float>::quiet_NaN();
  std::vector<std::uint32_t> place(grid_.size(), GONE);
  DescribedCloud result;
  for (std::size_t i = 0; i < grid_.size(); ++i)
    if (!grid_.isRemoved(i)) {
      place[grid_.row(i)] = static_cast<std::uint32_t>(i);
      ++result.size;
    }
  if (every_keypoint)
    result.size = grid_.size();
  const bool described = content == ScanContent::Descriptors;
  const SurfaceArrays arrays = grid_.arrays();
  result.points.reserve(3 * result.size);
  result.normals.reserve(3 * result.size);
  result.curvatures.reserve(result.size);
  result.descriptors.reserve(described ? FPFH_BINS * result.size : 0);
  for (std::size_t row = 0; row < place.size(); ++row) {
    const std::uint32_t i = place[row];
    const float* point = keypoints_.data() + 3 * row;
    if (i == GONE && !every_keypoint)
      continue;
    result.points.insert(result.points.end(), point, point + 3);
    if (i == GONE) {
      result.normals.insert(result.normals.end(), 3, NONE);
      result.curvatures.push_back(0);
      continue;
    }
    result.normals.insert(result.normals.end(),
                          {arrays.nx[i], arrays.ny[i], arrays.nz[i]});
    result.curvatures.push_back(curvatures_[i]);
    if (!described)
      continue;
    const float* histogram = feature_histograms_.data() + i * HISTOGRAM_STRIDE;
    result.descriptors.insert(
        result.descriptors.end(), histogram, histogram + FPFH_BINS);
  }
  return result;
}

} // namespace cpu
} // namespace pcl_flashreg
