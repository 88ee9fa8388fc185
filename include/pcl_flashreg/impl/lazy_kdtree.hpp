// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/lazy_kdtree.h>

#include <pcl/common/point_tests.h>
#include <pcl/search/impl/kdtree.hpp>
#include <pcl/search/impl/search.hpp>

#include <algorithm>
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
  // PCL's tree prints an error for a cloud without a finite point.
  const auto is_finite = [](const PointT& point) { return pcl::isXYZFinite(point); };
  has_points_ =
      input_ &&
      (indices_ ? std::any_of(indices_->begin(),
                              indices_->end(),
                              [&](auto index) { return is_finite((*input_)[index]); })
                : std::any_of(input_->begin(), input_->end(), is_finite));
  if (has_points_)
    tree_->setInputCloud(input_, indices_);
  built_ = true;
  return has_points_;
}

template <typename PointT>
int
LazyKdTree<PointT>::nearestKSearch(const PointT& point,
                                   int k,
                                   pcl::Indices& k_indices,
                                   std::vector<float>& k_sqr_distances) const
{
  if (build() && pcl::isXYZFinite(point))
    return tree_->nearestKSearch(point, k, k_indices, k_sqr_distances);
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
  if (build() && pcl::isXYZFinite(point))
    return tree_->radiusSearch(point, radius, k_indices, k_sqr_distances, max_nn);
  k_indices.clear();
  k_sqr_distances.clear();
  return 0;
}

} // namespace pcl_flashreg
