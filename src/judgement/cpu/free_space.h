// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/array.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief The space between a sensor and what it saw, which therefore is empty: an image
 * of the ranges on the six faces of a cube around the viewpoint. */
class FreeSpace {
public:
  /** \param[in] points what was seen
   * \param[in] viewpoint in the frame of the points
   * \param[in] spacing distance of neighbouring points, > 0 */
  void
  build(const Array<Eigen::Vector3f>& points,
        const Eigen::Vector3f& viewpoint,
        float spacing);

  /** \brief Nothing is known to be empty: the viewpoint is not known. */
  void
  clear()
  {
    nearest_.clear();
  }

  /** \brief Whether the viewpoint is known. */
  bool
  known() const
  {
    return !nearest_.empty();
  }

  /** \brief Whether something was seen beyond this place, by more than the margin: then
   * there can be nothing here. */
  bool
  contains(const Eigen::Vector3f& place, float margin) const
  {
    if (!known())
      return false;
    const Eigen::Vector3f ray = place - viewpoint_;
    const float limit = nearest_[pixelOf(ray)] - margin;
    return limit > 0 && ray.squaredNorm() < limit * limit;
  }

  /** \brief Of memory. */
  std::size_t
  bytes() const
  {
    return nearest_.capacity() * sizeof(float);
  }

private:
  std::size_t
  pixelOf(const Eigen::Vector3f& ray) const;

  Eigen::Vector3f viewpoint_ = Eigen::Vector3f::Zero();
  /** \brief Pixels along the edge of a face. */
  int edge_ = 0;
  /** \brief Per pixel the smallest range in it and the pixels around it; 0 where nothing
   * was seen in the pixel itself. */
  std::vector<float> nearest_;
};

} // namespace pcl_flashreg
