// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/lazy_kdtree.h>

#include <pcl/common/point_tests.h>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/search/impl/search.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace pcl_flashreg {

template <typename PointT>
auto
LazyKdTree<PointT>::setInputCloud(const PointCloudConstPtr& cloud,
                                  const pcl::IndicesConstPtr& indices)
    -> decltype(std::declval<Base&>().setInputCloud(cloud, indices))
{
  input_ = cloud;
  indices_ = indices;
  built_ = false;
  using Returned = decltype(std::declval<Base&>().setInputCloud(cloud, indices));
  if constexpr (!std::is_void_v<Returned>)
    return cloud && !(indices ? indices->empty() : cloud->empty());
}

template <typename PointT>
bool
LazyKdTree<PointT>::build() const
{
  if (built_)
    return has_points_;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (built_)
    return has_points_;
  plant();
  built_ = true;
  return has_points_;
}

template <typename PointT>
std::vector<float>
LazyKdTree<PointT>::collectFinite(std::size_t length) const
{
  finite_.clear();
  std::vector<float> rows;
  if (!input_)
    return rows;
  const auto& representation = *tree_->getPointRepresentation();
  const auto append = [&](pcl::index_t index) {
    rows.resize(rows.size() + length);
    float* const row = rows.data() + rows.size() - length;
    representation.copyToFloatArray((*input_)[index], row);
    if (std::all_of(row, row + length, [](float x) { return std::isfinite(x); }))
      finite_.push_back(index);
    else
      rows.resize(rows.size() - length);
  };
  if (indices_)
    std::for_each(indices_->begin(), indices_->end(), append);
  else
    for (std::size_t i = 0; i < input_->size(); ++i)
      append(static_cast<pcl::index_t>(i));
  return rows;
}

template <typename PointT>
void
LazyKdTree<PointT>::plant() const
{
  const auto length = static_cast<std::size_t>(
      tree_->getPointRepresentation()->getNumberOfDimensions());
  const std::vector<float> rows = collectFinite(length);
  // PCL's tree prints an error for a cloud without a finite point.
  has_points_ = !finite_.empty();
  equal_ = detail::EqualRows(
      finite_.size(), length, [&](std::size_t i) { return &rows[i * length]; });
  if (equal_.allDiffer()) {
    finite_ = pcl::Indices();
    if (has_points_)
      tree_->setInputCloud(input_, indices_);
    return;
  }
  place_of_.resize(input_->size());
  const pcl::IndicesPtr different(new pcl::Indices);
  for (const std::uint32_t place : equal_.firsts()) {
    different->push_back(finite_[place]);
    place_of_[static_cast<std::size_t>(finite_[place])] = place;
  }
  tree_->setInputCloud(input_, different);
}

template <typename PointT>
int
LazyKdTree<PointT>::addEqual(pcl::Indices& indices,
                             std::vector<float>& sqr_distances,
                             std::size_t most) const
{
  if (equal_.allDiffer())
    return static_cast<int>(indices.size());
  std::vector<std::pair<float, pcl::index_t>> found;
  for (std::size_t i = 0; i < indices.size(); ++i)
    found.emplace_back(sqr_distances[i], indices[i]);
  // Where the tree does not sort, the nearest need not come first.
  std::sort(found.begin(), found.end());
  indices.clear();
  sqr_distances.clear();
  for (const auto& [squared, first] : found)
    for (std::uint32_t place = place_of_[static_cast<std::size_t>(first)];
         place != detail::EqualRows::NONE && indices.size() < most;
         place = equal_.next(place)) {
      indices.push_back(finite_[place]);
      sqr_distances.push_back(squared);
    }
  return static_cast<int>(indices.size());
}

template <typename PointT>
int
LazyKdTree<PointT>::nearestKSearch(const PointT& point,
                                   int k,
                                   pcl::Indices& k_indices,
                                   std::vector<float>& k_sqr_distances) const
{
  if (build() && pcl::isXYZFinite(point)) {
    tree_->nearestKSearch(point, k, k_indices, k_sqr_distances);
    return addEqual(k_indices, k_sqr_distances, static_cast<std::size_t>(k));
  }
  k_indices.clear();
  std::fill(k_sqr_distances.begin(),
            k_sqr_distances.end(),
            std::numeric_limits<float>::infinity());
  return 0;
}

template <typename PointT>
int
LazyKdTree<PointT>::radiusSearch(const PointT& point,
                                 double radius,
                                 pcl::Indices& k_indices,
                                 std::vector<float>& k_sqr_distances,
                                 unsigned int max_nn) const
{
  if (build() && pcl::isXYZFinite(point)) {
    tree_->radiusSearch(point, radius, k_indices, k_sqr_distances, max_nn);
    const auto any_number = std::numeric_limits<std::size_t>::max();
    return addEqual(k_indices, k_sqr_distances, max_nn == 0 ? any_number : max_nn);
  }
  k_indices.clear();
  k_sqr_distances.clear();
  return 0;
}

} // namespace pcl_flashreg
