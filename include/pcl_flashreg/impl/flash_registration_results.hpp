// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The part of FlashRegistration that keeps and tells results.

#pragma once

#include <pcl_flashreg/flash_registration.h>
#include <pcl_flashreg/impl/equal_rows.hpp>
#include <pcl_flashreg/impl/move_cloud.hpp>

#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>

#include <cstdint>
#include <vector>

namespace pcl_flashreg {

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::resetResult()
{
  converged_ = false;
  final_transformation_ = transformation_ = Matrix4::Identity();
  // A new one: a copy of this object shares the old one.
  correspondences_.reset(new pcl::Correspondences);
  result_ = {};
  timings_ = {};
  estimated_resolution_ = 0;
  error_message_ = missingInput();
  inliers_ = pcl::Indices();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::fail(const std::string& message)
{
  PCL_ERROR(
      "[pcl::%s::computeTransformation] %s\n", getClassName().c_str(), message.c_str());
  error_message_ = message;
  inliers_ = pcl::Indices();
  converged_ = false;
  final_transformation_ = transformation_ = Matrix4::Identity();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::describeOutput(
    PointCloudSource& output) const
{
  const auto size = output.size();
  const bool whole =
      size == input_->size() && size == std::size_t{input_->width} * input_->height;
  output.width = whole ? input_->width : static_cast<std::uint32_t>(size);
  output.height = whole ? input_->height : 1;
  output.header = input_->header;
  output.is_dense = input_->is_dense;
  output.sensor_origin_ = input_->sensor_origin_;
  output.sensor_orientation_ = input_->sensor_orientation_;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::applyResult(
    PointCloudSource& output)
{
  const Eigen::Matrix4d T_target_source =
      result_.T_target_source.template toMatrix<double>();
  final_transformation_ = transformation_ = T_target_source.template cast<float>();
  inliers_.reset();
  converged_ = result_.converged;
  const bool in_place = &output == input_.get();
  // In place, the inliers can't be searched for, and the descriptors not be used,
  // later.
  if (inlier_fraction_ > 0 || in_place)
    converged_ &= static_cast<float>(getInliers().size()) >=
                  inlier_fraction_ * static_cast<float>(indices_->size());
  if (in_place) {
    source_side_.reset();
    known_estimate_.reset();
  }
  // The output holds a copy of the source by now.
  detail::moveCloud(output, result_.T_target_source);
}

template <typename PointSource, typename PointTarget, typename FeatureT>
pcl::Correspondences
FlashRegistration<PointSource, PointTarget, FeatureT>::getInlierCorrespondences() const
{
  pcl::Correspondences inliers;
  inliers.reserve(result_.inliers.size());
  for (const int row : result_.inliers)
    inliers.push_back((*correspondences_)[row]);
  return inliers;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
const pcl::Indices&
FlashRegistration<PointSource, PointTarget, FeatureT>::getInliers() const
{
  if (inliers_)
    return *inliers_;
  if (tree_->getInputCloud() != target_ && !force_no_recompute_)
    tree_->setInputCloud(target_);
  const RigidTransform& pose = result_.T_target_source;
  pcl::Indices neighbor(1);
  std::vector<float> squared_distance(1);
  const auto reaches_target = [&](const PointSource& point) {
    const Eigen::Vector3f moved =
        (pose.rotation * point.getVector3fMap().template cast<double>() +
         pose.translation)
            .template cast<float>();
    PointTarget query;
    query.getVector3fMap() = moved;
    return tree_->nearestKSearch(query, 1, neighbor, squared_distance) > 0 &&
           squared_distance[0] < inlier_distance_ * inlier_distance_;
  };
  pcl::Indices finite;
  for (const auto index : *indices_)
    if (pcl::isXYZFinite((*input_)[index]))
      finite.push_back(index);
  // Beams without a return are often stored as thousands of equal points.
  const detail::EqualRows equal(finite.size(), 3, [&](std::size_t i) {
    return (*input_)[finite[i]].getVector3fMap().data();
  });
  std::vector<bool> is_inlier(finite.size());
  for (const std::uint32_t first : equal.firsts())
    if (reaches_target((*input_)[finite[first]]))
      for (std::uint32_t i = first; i != detail::EqualRows::NONE; i = equal.next(i))
        is_inlier[i] = true;
  inliers_.emplace();
  for (std::size_t i = 0; i < finite.size(); ++i)
    if (is_inlier[i])
      inliers_->push_back(finite[i]);
  return *inliers_;
}

} // namespace pcl_flashreg
