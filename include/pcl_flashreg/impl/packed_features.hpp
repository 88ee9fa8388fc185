// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_matching.h>

#include <pcl/point_cloud.h>
#include <pcl/point_representation.h>

#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief Descriptors as rows of floats. */
class PackedFeatures {
public:
  /** \param[in] representation how a descriptor becomes floats */
  template <typename FeatureT>
  PackedFeatures(const pcl::PointCloud<FeatureT>& features,
                 const pcl::PointRepresentation<FeatureT>& representation)
      : dimension_(representation.getNumberOfDimensions()),
        values_(features.size() * dimension_)
  {
    for (std::size_t i = 0; i < features.size(); ++i) {
      float* row = values_.data() + i * dimension_;
      representation.vectorize(features[i], row);
    }
  }

  FeatureView
  view() const
  {
    return {values_.data(), values_.size() / dimension_, dimension_, dimension_};
  }

private:
  std::size_t dimension_;
  std::vector<float> values_;
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
