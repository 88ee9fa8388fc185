// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief A keypoint that tells where it was seen from. */
struct SurfaceElement {
  Eigen::Vector3f point;
  /** \brief Of unit length and either sign. */
  Eigen::Vector3f normal;
  /** \brief Logarithm of the number of points of the cloud that it stands for. */
  float log_count = 0;
  /** \brief Flat enough to hide what lies behind it; leaves and cables are not. */
  bool solid = false;
};

/** \brief How well a place explains points as those that a sensor saw from there.
 *
 * Two things tell. No surface hides another: what lies in one direction lies at one range.
 * And points thin out as rays that are spread evenly over directions do when they meet a
 * surface: with the cosine of the angle of incidence over the squared range; unless
 * somebody has thinned them already, in which case this says nothing about any place.
 */
class Visibility {
public:
  /** \param[in] elements so ordered that any first ones are spread over all of the surface
   * \param[in] surface_size number of keypoints that they were taken from
   * \param[in] spacing distance of neighbouring keypoints, > 0 */
  Visibility(std::vector<SurfaceElement> elements,
             std::size_t surface_size,
             float spacing);

  std::size_t
  size() const
  {
    return elements_.size();
  }

  const std::vector<SurfaceElement>&
  elements() const
  {
    return elements_;
  }

  /** \brief Mean of the points. */
  const Eigen::Vector3f&
  middle() const
  {
    return middle_;
  }

  /** \brief Median distance of a point from the middle. */
  float
  extent() const
  {
    return extent_;
  }

  /** \brief Share of the points that others would hide, in [0, 1].
   * \param[in] count how many elements are looked at; for comparisons of places the same */
  double
  hiddenShare(const Eigen::Vector3f& place, std::size_t count) const;

  /** \brief Correlation of the points' density with that of rays from the place, in
   * [-1, 1]; 0 where the density is the same everywhere. */
  double
  thinning(const Eigen::Vector3f& place, std::size_t count) const;

  /** \brief Smaller is likelier: the hidden share less half the correlation, and a little
   * for places many times as far away as the cloud is large. */
  double
  implausibility(const Eigen::Vector3f& place, std::size_t count) const;

private:
  std::vector<SurfaceElement> elements_;
  std::size_t surface_size_;
  float spacing_;
  Eigen::Vector3f middle_ = Eigen::Vector3f::Zero();
  float extent_ = 0;
};

} // namespace cpu
} // namespace pcl_flashreg
