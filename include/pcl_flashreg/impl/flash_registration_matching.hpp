// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The part of FlashRegistration that finds correspondences.

#pragma once

#include <pcl_flashreg/flash_registration.h>
#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/packed_features.hpp>

#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace detail {

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

/** \brief Normals that the points bring along, where their type has any. */
template <typename PointT>
void
addNormals(const pcl::PointCloud<PointT>& cloud, ScanInput<float>& input)
{
  if constexpr (pcl::traits::has_normal<PointT>::value)
    if (!cloud.empty() && sizeof(PointT) % sizeof(float) == 0) {
      input.normals = &cloud[0].normal_x;
      input.normal_stride = sizeof(PointT) / sizeof(float);
    }
}

/** \brief Matches of keypoints as correspondences of the points that these are. */
inline void
appendMatches(const PairResult& result, pcl::Correspondences& correspondences)
{
  const auto point_of = [](const Scan& scan, std::int32_t row) {
    return scan.origins() ? scan.origins()[row] : row;
  };
  correspondences.reserve(result.matches.size());
  for (const FeatureMatch& match : result.matches)
    correspondences.emplace_back(point_of(result.source, match.query),
                                 point_of(result.target, match.match),
                                 match.squared_distance);
}

} // namespace detail

template <typename PointSource, typename PointTarget, typename FeatureT>
PairResult
FlashRegistration<PointSource, PointTarget, FeatureT>::alignInputs(
    const PairOptions& options)
{
  if (source_side_.setIndices(sourceIndices()))
    known_estimate_.reset();
  const detail::FloatRows<PointSource> source_rows(*input_, source_side_.indices());
  const detail::FloatRows<PointTarget> target_rows(*target_, {});
  ScanInput<float> source = source_side_.inputFrom(*input_, source_rows);
  ScanInput<float> target = target_side_.inputFrom(*target_, target_rows);
  if (given_correspondences_)
    return alignCorrespondences(source, target, options);
  if (source_features_ || target_features_)
    return alignGivenFeatures(source, target, options);
  return alignComputedFeatures(source, target, options);
}

template <typename PointSource, typename PointTarget, typename FeatureT>
PairResult
FlashRegistration<PointSource, PointTarget, FeatureT>::alignCorrespondences(
    const ScanInput<float>& source,
    const ScanInput<float>& target,
    const PairOptions& options)
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
  return registration_.get().align(source, target, buffer_.view(), options);
}

template <typename PointSource, typename PointTarget, typename FeatureT>
PairResult
FlashRegistration<PointSource, PointTarget, FeatureT>::alignGivenFeatures(
    ScanInput<float>& source, ScanInput<float>& target, const PairOptions& options)
{
  detail::checkOneToOne<PointSource, FeatureT>("source", *input_, source_features_);
  detail::checkOneToOne<PointTarget, FeatureT>("target", *target_, target_features_);
  const detail::PackedFeatures from(*source_features_, *feature_representation_);
  const detail::PackedFeatures to(*target_features_, *feature_representation_);
  source.features = from.view();
  target.features = to.view();
  detail::addNormals(*input_, source);
  detail::addNormals(*target_, target);
  // Nobody says when descriptors change.
  source.made = target.made = nullptr;
  const PairResult result = registration_.get().align(source, target, options);
  detail::appendMatches(result, *correspondences_);
  return result;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
PairResult
FlashRegistration<PointSource, PointTarget, FeatureT>::alignComputedFeatures(
    ScanInput<float>& source, ScanInput<float>& target, PairOptions options)
{
  PairRegistration& registration = registration_.get();
  if (!options.resolution)
    options.resolution = known_estimate_;
  if (front_end_ == FrontEnd::Pcl) {
    if (!options.resolution)
      options.resolution = registration.chooseResolution(source, target);
    const unsigned threads = registration_.numThreads();
    timings_.source_features =
        source_side_.describeWithPcl(*input_, *options.resolution, threads, source);
    timings_.target_features =
        target_side_.describeWithPcl(*target_, *options.resolution, threads, target);
  }
  const PairResult result = registration.align(source, target, options);
  if (resolution_ == 0)
    known_estimate_ = result.resolution;
  source_side_.keep(*input_, result.source);
  target_side_.keep(*target_, result.target);
  for (const FeatureMatch& match : result.matches)
    correspondences_->emplace_back(match.query, match.match, match.squared_distance);
  if (front_end_ == FrontEnd::Native) {
    timings_.source_features = detail::toFpfhTimings(result.timings.source);
    timings_.target_features = detail::toFpfhTimings(result.timings.target);
  }
  return result;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
std::string
FlashRegistration<PointSource, PointTarget, FeatureT>::keypointsLeft() const
{
  if (given_correspondences_ || source_features_ || target_features_)
    return "";
  return " (the resolution of " + detail::toText(getResolution()) + " leaves " +
         std::to_string(source_side_.scan().size()) + " source and " +
         std::to_string(target_side_.scan().size()) + " target keypoints)";
}

template <typename PointSource, typename PointTarget, typename FeatureT>
pcl::Indices
FlashRegistration<PointSource, PointTarget, FeatureT>::sourceIndices() const
{
  return fake_indices_ ? pcl::Indices() : *indices_;
}

} // namespace pcl_flashreg
