// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_matching.h>

#include <pcl/common/point_tests.h>
#include <pcl/point_cloud.h>
#include <pcl/point_representation.h>

#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief Descriptors of some points of a cloud as rows of floats, and whose they are.
 */
class PackedFeatures {
public:
  /** \brief Packs the descriptors of the points with finite coordinates.
   * \param[in] points the cloud
   * \param[in] features one a point of the whole cloud
   * \param[in] indices the points to take; null for all of them
   * \param[in] representation how a descriptor becomes floats */
  template <typename PointT, typename FeatureT>
  PackedFeatures(const pcl::PointCloud<PointT>& points,
                 const pcl::PointCloud<FeatureT>& features,
                 const pcl::Indices* indices,
                 const pcl::PointRepresentation<FeatureT>& representation)
      : dimension_(representation.getNumberOfDimensions())
  {
    const std::size_t size = indices ? indices->size() : points.size();
    values_.reserve(size * dimension_);
    rows_.reserve(size);
    for (std::size_t i = 0; i < size; ++i) {
      const auto index = indices ? (*indices)[i] : static_cast<pcl::index_t>(i);
      if (!pcl::isXYZFinite(points.at(index)))
        continue;
      rows_.push_back(index);
      values_.resize(values_.size() + dimension_);
      float* row = values_.data() + values_.size() - dimension_;
      representation.vectorize(features[index], row);
    }
  }

  FeatureView
  view() const
  {
    return {values_.data(), rows_.size(), dimension_, dimension_};
  }

  /** \brief Index of the point that row i belongs to. */
  pcl::index_t
  pointOf(std::size_t row) const
  {
    return rows_[row];
  }

private:
  std::size_t dimension_;
  std::vector<float> values_;
  pcl::Indices rows_;
};

/** \brief PCL's representation of a descriptor type; of a type that PCL knows nothing
 * of, where that keeps three floats only, all its floats. */
template <typename FeatureT>
typename pcl::PointRepresentation<FeatureT>::ConstPtr
defaultFeatureRepresentation()
{
  using Default = pcl::DefaultPointRepresentation<FeatureT>;
  const typename Default::Ptr representation(new Default);
  if (!representation->isTrivial())
    return representation;
  using AllFloats = pcl::CustomPointRepresentation<FeatureT>;
  return typename AllFloats::Ptr(new AllFloats(sizeof(FeatureT) / sizeof(float)));
}

} // namespace detail
} // namespace pcl_flashreg
