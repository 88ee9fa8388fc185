// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The part of FlashRegistration that finds correspondences.

#pragma once

#include <pcl_flashreg/flash_registration.h>
#include <pcl_flashreg/impl/packed_features.hpp>

#include <sstream>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace detail {

inline FeatureView
viewOf(const Fpfh33& features)
{
  constexpr std::size_t stride = sizeof(pcl::FPFHSignature33) / sizeof(float);
  return {features.empty() ? nullptr : features[0].histogram,
          features.size(),
          pcl::FPFHSignature33::descriptorSize(),
          stride};
}

template <typename PointT, typename FeatureT>
void
checkOneToOne(const char* name,
              const pcl::PointCloud<PointT>& points,
              const typename pcl::PointCloud<FeatureT>::ConstPtr& features)
{
  const std::string role = name;
  if (!features)
    throw std::invalid_argument("no " + role + " features were given, only the others");
  if (features->size() != points.size())
    throw std::invalid_argument("there are " + std::to_string(features->size()) + " " +
                                role + " features for " +
                                std::to_string(points.size()) + " points");
}

} // namespace detail

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::findCorrespondences()
{
  clouds_.reset();
  if (given_correspondences_)
    takeGivenCorrespondences();
  else if (source_features_ || target_features_)
    matchGivenFeatures();
  else
    matchComputedFeatures();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::takeGivenCorrespondences()
{
  *correspondences_ = *given_correspondences_;
  if (!fake_indices_) {
    std::vector<bool> selected(input_->size(), false);
    for (const auto index : *indices_)
      selected[index] = true;
    for (auto& correspondence : *correspondences_) {
      const auto query = static_cast<std::size_t>(correspondence.index_query);
      if (query < selected.size() && !selected[query])
        correspondence.index_match = detail::no_match;
    }
  }
  buffer_.gather(*input_, *target_, *correspondences_);
  estimateGivenResolution();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::matchGivenFeatures()
{
  detail::checkOneToOne<PointSource, FeatureT>("source", *input_, source_features_);
  detail::checkOneToOne<PointTarget, FeatureT>("target", *target_, target_features_);
  const detail::Stopwatch matching;
  const detail::PackedFeatures source(
      *input_, *source_features_, indices_.get(), *feature_representation_);
  const detail::PackedFeatures target(
      *target_, *target_features_, nullptr, *feature_representation_);
  const auto matches =
      workers_.matcher().match(source.view(), target.view(), k_correspondences_);
  correspondences_->reserve(matches.size());
  for (const FeatureMatch& match : matches)
    correspondences_->emplace_back(source.pointOf(match.query),
                                   target.pointOf(match.match),
                                   match.squared_distance);
  timings_.matching = matching.milliseconds();
  buffer_.gather(*input_, *target_, *correspondences_);
  estimateGivenResolution();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::matchComputedFeatures()
{
  source_cache_.setIndices(sourceIndices());
  if (resolution_ == 0)
    estimated_resolution_ = std::max(source_cache_.estimatedResolution(*input_),
                                     target_cache_.estimatedResolution(*target_));
  timings_.source_features =
      source_cache_.update(*input_, getResolution(), front_end_, workers_);
  timings_.target_features =
      target_cache_.update(*target_, getResolution(), front_end_, workers_);

  const detail::Stopwatch matching;
  const FpfhCloud& source = source_cache_.fpfh();
  const FpfhCloud& target = target_cache_.fpfh();
  const auto matches = workers_.matcher().match(detail::viewOf(*source.features),
                                                detail::viewOf(*target.features),
                                                k_correspondences_);
  correspondences_->reserve(matches.size());
  for (const FeatureMatch& match : matches)
    correspondences_->emplace_back(match.query, match.match, match.squared_distance);
  timings_.matching = matching.milliseconds();
  buffer_.gather(*source.points, *target.points, *correspondences_);
  if (cloud_check_)
    gatherClouds(source, target);
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::gatherClouds(
    const FpfhCloud& source, const FpfhCloud& target)
{
  const auto viewpoint = [this](const auto& cloud) -> std::optional<Eigen::Vector3d> {
    if (!viewpoints_known_)
      return std::nullopt;
    return cloud.sensor_origin_.template head<3>().template cast<double>();
  };
  source_buffer_.gather(source, Eigen::Vector3f::Zero(), viewpoint(*input_));
  target_buffer_.gather(target, Eigen::Vector3f::Zero(), viewpoint(*target_));
  clouds_ = CloudPairView<float>{
      source_buffer_.view(), target_buffer_.view(), getResolution()};
}

template <typename PointSource, typename PointTarget, typename FeatureT>
std::string
FlashRegistration<PointSource, PointTarget, FeatureT>::keypointsLeft() const
{
  if (given_correspondences_ || source_features_ || target_features_)
    return "";
  std::ostringstream text;
  text << " (the resolution of " << getResolution() << " leaves "
       << source_cache_.fpfh().points->size() << " source and "
       << target_cache_.fpfh().points->size() << " target keypoints)";
  return text.str();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
pcl::Indices
FlashRegistration<PointSource, PointTarget, FeatureT>::sourceIndices() const
{
  return fake_indices_ ? pcl::Indices() : *indices_;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::estimateGivenResolution()
{
  if (resolution_ == 0 && !parameters_)
    estimated_resolution_ = std::max(estimateVoxelSize(*input_, sourceIndices()),
                                     estimateVoxelSize(*target_));
}

} // namespace pcl_flashreg
