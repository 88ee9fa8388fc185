// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/correspondence_rejector_flashreg.h>

#include <pcl/console/print.h>
#include <pcl/conversions.h>

#include <exception>
#include <utility>

namespace pcl_flashreg {

template <typename PointT>
Parameters
CorrespondenceRejectorFlashReg<PointT>::getParameters() const
{
  constexpr double default_threshold = 0.05;
  Parameters parameters;
  if (parameters_)
    parameters = *parameters_;
  else if (resolution_ != 0)
    parameters = Parameters::fromResolution(resolution_);
  else
    parameters =
        Parameters::fromResolution(0.5 * inlier_threshold_.value_or(default_threshold));
  if (inlier_threshold_)
    parameters.inlier_distance = static_cast<float>(*inlier_threshold_);
  applyMotion(parameters);
  return parameters;
}

template <typename PointT>
void
CorrespondenceRejectorFlashReg<PointT>::getRemainingCorrespondences(
    const pcl::Correspondences& original_correspondences,
    pcl::Correspondences& remaining_correspondences)
{
  result_ = {};
  inlier_indices_.clear();
  if (!input_ || !target_) {
    PCL_ERROR("[pcl::registration::%s::getRemainingCorrespondences] No input %s "
              "dataset was given!\n",
              getClassName().c_str(),
              input_ ? "target" : "source");
    return;
  }
  // The output may be the input.
  pcl::Correspondences remaining = original_correspondences;
  try {
    buffer_.gather(*input_, *target_, original_correspondences);
    // A filter of correspondences goes by these: without clouds.
    result_ = registration_.get()
                  .align(ScanInput<float>(),
                         ScanInput<float>(),
                         buffer_.view(),
                         optionsWith(getParameters()))
                  .pose;
    if (result_.status == Status::Ok) {
      const pcl::Indices inliers = findInliers(original_correspondences);
      remaining.clear();
      for (const auto position : inliers)
        remaining.push_back(original_correspondences[position]);
      if (save_inliers_)
        inlier_indices_ = inliers;
    }
  }
  catch (const std::exception& error) {
    result_ = {};
    PCL_ERROR("[pcl::registration::%s::getRemainingCorrespondences] %s\n",
              getClassName().c_str(),
              error.what());
  }
  remaining_correspondences = std::move(remaining);
}

template <typename PointT>
pcl::Indices
CorrespondenceRejectorFlashReg<PointT>::findInliers(
    const pcl::Correspondences& correspondences) const
{
  const RigidTransform& pose = result_.T_target_source;
  const double threshold = getInlierThreshold();
  pcl::Indices inliers;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const auto& correspondence = correspondences[i];
    if (correspondence.index_query == detail::no_match ||
        correspondence.index_match == detail::no_match)
      continue;
    const Eigen::Vector3d source =
        (*input_)[correspondence.index_query].getVector3fMap().template cast<double>();
    const Eigen::Vector3d target =
        (*target_)[correspondence.index_match].getVector3fMap().template cast<double>();
    if ((pose.rotation * source + pose.translation - target).norm() < threshold)
      inliers.push_back(static_cast<pcl::index_t>(i));
  }
  return inliers;
}

template <typename PointT>
void
CorrespondenceRejectorFlashReg<PointT>::setSourcePoints(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  typename PointCloud::Ptr points(new PointCloud);
  pcl::fromPCLPointCloud2(*cloud, *points);
  setInputSource(points);
}

template <typename PointT>
void
CorrespondenceRejectorFlashReg<PointT>::setTargetPoints(
    pcl::PCLPointCloud2::ConstPtr cloud)
{
  typename PointCloud::Ptr points(new PointCloud);
  pcl::fromPCLPointCloud2(*cloud, *points);
  setInputTarget(points);
}

} // namespace pcl_flashreg
