// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl/search/kdtree.h>

#include <atomic>
#include <mutex>
#include <utility>

namespace pcl_flashreg {

/** \brief A pcl::search::KdTree that is built by the first query instead of by
 * setInputCloud().
 *
 * pcl::Registration::align() hands the target to its tree before every computation,
 * which costs more than the whole of a registration that does not search the target;
 * with this tree getFitnessScore() and getInliers() still work, and only they pay. The
 * cloud must not be changed between setInputCloud() and the first query. Queries may
 * come from several threads at once; setters may not.
 *
 * A query point that is not finite has no neighbours (pcl::search::KdTree aborts on it
 * where assertions are on), and an infinite distance where the caller's array has room
 * for one, so that getFitnessScore() skips it.
 */
template <typename PointT>
class LazyKdTree : public pcl::search::KdTree<PointT> {
  using Base = pcl::search::KdTree<PointT>;

public:
  using Ptr = pcl::shared_ptr<LazyKdTree<PointT>>;
  using ConstPtr = pcl::shared_ptr<const LazyKdTree<PointT>>;
  using PointCloudConstPtr = typename Base::PointCloudConstPtr;

  using Base::nearestKSearch;
  using Base::radiusSearch;

  /** \param[in] sorted whether neighbours come in ascending order of their distance */
  explicit LazyKdTree(bool sorted = true) : Base(sorted) {}

  /** \brief Remembers the cloud; the tree is built by the first query. Returns what
   * pcl::search::KdTree returns: nothing up to PCL 1.13, whether there is anything to
   * search later on. */
  auto
  setInputCloud(const PointCloudConstPtr& cloud,
                const pcl::IndicesConstPtr& indices = pcl::IndicesConstPtr())
      -> decltype(std::declval<Base&>().setInputCloud(cloud, indices)) override;

  int
  nearestKSearch(const PointT& point,
                 int k,
                 pcl::Indices& k_indices,
                 std::vector<float>& k_sqr_distances) const override;

  int
  radiusSearch(const PointT& point,
               double radius,
               pcl::Indices& k_indices,
               std::vector<float>& k_sqr_distances,
               unsigned int max_nn = 0) const override;

  /** \brief Whether a query has built the tree for the present cloud. */
  bool
  isBuilt() const
  {
    return built_;
  }

protected:
  using Base::indices_;
  using Base::input_;
  using Base::tree_;

private:
  /** \brief Builds the tree where that is still to be done.
   * \return whether there are points to search */
  bool
  build() const;

  mutable std::atomic<bool> built_{false};
  /** \brief Of the cloud; valid once built_ is true. */
  mutable bool has_points_ = false;
  mutable std::mutex mutex_;
};

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/lazy_kdtree.hpp>
