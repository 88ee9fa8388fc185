// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/impl/equal_rows.hpp>

#include <pcl/search/kdtree.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

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
 *
 * Of points that are equal the tree holds one, and the others follow it in what is found, by
 * their place in the indices: a k-d tree looks at all of them for every query that is near,
 * which takes the square of their number where beams without a return are stored as zeros.
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

  void
  plant() const;

  /** \brief Fills finite_.
   * \return its points as the tree sees them, `length` values each */
  std::vector<float>
  collectFinite(std::size_t length) const;

  /** \brief Puts the points that equal those found behind them; at most so many of all. */
  int
  addEqual(pcl::Indices& indices,
           std::vector<float>& sqr_distances,
           std::size_t most) const;

  mutable std::atomic<bool> built_{false};
  /** \brief Of the cloud; valid once built_ is true. */
  mutable bool has_points_ = false;
  /** \brief Where some are equal: the finite ones of the points to search, which of these
   * are equal, and where the first of each kind is among them, by its number in the cloud. */
  mutable pcl::Indices finite_;
  mutable detail::EqualRows equal_;
  mutable std::vector<std::uint32_t> place_of_;
  mutable std::mutex mutex_;
};

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/lazy_kdtree.hpp>
