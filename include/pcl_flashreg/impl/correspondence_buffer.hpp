// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/estimator.h>

#include <pcl/correspondence.h>
#include <pcl/point_cloud.h>

#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief Marks a correspondence without a match, as pcl::Correspondence does. */
constexpr auto no_match = static_cast<pcl::index_t>(-1);

/** \brief Correspondences between two clouds in the packed form that the core takes;
 * row i is correspondence i. */
class CorrespondenceBuffer {
public:
  /** \brief Gathers the points. A correspondence without a match becomes a row that is
   * not finite, which the core ignores, so that the numbering stays the caller's.
   * \throws std::out_of_range if an index is not one of its cloud */
  template <typename PointSource, typename PointTarget>
  void
  gather(const pcl::PointCloud<PointSource>& source,
         const pcl::PointCloud<PointTarget>& target,
         const pcl::Correspondences& correspondences)
  {
    source_xyz_.clear();
    target_xyz_.clear();
    ranks_.clear();
    for (const auto& correspondence : correspondences) {
      if (correspondence.index_query == no_match ||
          correspondence.index_match == no_match) {
        source_xyz_.insert(source_xyz_.end(), 3, nan);
        target_xyz_.insert(target_xyz_.end(), 3, nan);
      }
      else {
        append(source, correspondence.index_query, "source", source_xyz_);
        append(target, correspondence.index_match, "target", target_xyz_);
      }
      ranks_.push_back(correspondence.distance);
    }
  }

  CorrespondenceView<float>
  view() const
  {
    return {source_xyz_.data(), target_xyz_.data(), ranks_.size(), ranks_.data()};
  }

private:
  static constexpr float nan = std::numeric_limits<float>::quiet_NaN();

  template <typename PointT>
  static void
  append(const pcl::PointCloud<PointT>& cloud,
         pcl::index_t index,
         const char* name,
         std::vector<float>& xyz)
  {
    if (static_cast<std::size_t>(index) >= cloud.size())
      throw std::out_of_range("a correspondence names point " + std::to_string(index) +
                              " of a " + name + " of " + std::to_string(cloud.size()) +
                              " points");
    const PointT& point = cloud[index];
    xyz.insert(xyz.end(), {point.x, point.y, point.z});
  }

  std::vector<float> source_xyz_;
  std::vector<float> target_xyz_;
  /** \brief Correspondence::distance: a smaller one is kept first. */
  std::vector<float> ranks_;
};

} // namespace detail
} // namespace pcl_flashreg
