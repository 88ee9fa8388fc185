// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "matching/cpu/distinct_features.h"

#include <Eigen/Core>

#include <cstddef>
#include <utility>

namespace pcl_flashreg {

/** \brief What is left of a descriptor in four dimensions. */
using Shadow = Eigen::Array4f;

/** \brief Principal components behind a shadow, of descriptors that have so many values. */
constexpr Eigen::Index SHADOW_COMPONENTS = Shadow::RowsAtCompileTime - 1;

/** \brief The space of the descriptors of a search, centred on the targets' mean and scaled
 * by a power of two, so that no value is large, and the shadows that they cast: the first
 * three principal components of the targets, and the length of what is orthogonal to
 * these. Shadows are never farther from each other than what casts them.
 */
class FeatureSpace {
public:
  FeatureSpace(const DistinctFeatures& queries, const DistinctFeatures& targets);

  /** \brief One that was made before: what mean(), components() and scale() gave out. */
  FeatureSpace(Eigen::RowVectorXd mean, Eigen::MatrixXd components, double scale)
      : mean_(std::move(mean)), components_(std::move(components)), scale_(scale)
  {
  }

  const Eigen::RowVectorXd&
  mean() const
  {
    return mean_;
  }

  /** \brief Orthonormal columns. */
  const Eigen::MatrixXd&
  components() const
  {
    return components_;
  }

  /** \brief Whether queries are not so much larger than the targets that a square could
   * overflow. */
  bool
  hasRoomFor(const DistinctFeatures& queries) const
  {
    constexpr double LARGE = 1e6;
    return static_cast<double>(queries.largest) * scale_ <= LARGE;
  }

  std::size_t
  dimension() const
  {
    return static_cast<std::size_t>(mean_.size());
  }

  /** \brief What every value is multiplied by. */
  double
  scale() const
  {
    return scale_;
  }

  /** \brief Centred and scaled values of a descriptor; `dimension` of them. */
  void
  centre(const float* descriptor, float* centred) const;

  /** \brief Shadows of descriptors [begin, end). */
  void
  cast(const DistinctFeatures& features,
       std::size_t begin,
       std::size_t end,
       Shadow* shadows) const;

  /** \brief By rounding, shadows may be this much farther from each other than what casts
   * them, times the sum of both centred lengths. */
  double
  slack() const;

private:
  Eigen::RowVectorXd mean_;
  Eigen::MatrixXd components_;
  double scale_ = 1;
};

} // namespace pcl_flashreg
