// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/flash_registration.h>
#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/packed_features.hpp>

#include <pcl/console/print.h>
#include <pcl/impl/pcl_base.hpp>

#include <algorithm>
#include <exception>
#include <numeric>
#include <string>
#include <type_traits>

namespace pcl_flashreg {

template <typename PointSource, typename PointTarget, typename FeatureT>
FlashRegistration<PointSource, PointTarget, FeatureT>::FlashRegistration()
    : feature_representation_(detail::defaultFeatureRepresentation<FeatureT>())
{
  reg_name_ = "FlashRegistration";
  error_message_ = missingInput();
  this->setSearchMethodTarget(
      typename LazyKdTree<PointTarget>::Ptr(new LazyKdTree<PointTarget>));
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::setInputSource(
    const PointCloudSourceConstPtr& cloud)
{
  if (cloud)
    Base::setInputSource(cloud);
  else
    PCL_ERROR("[pcl::%s::setInputSource] No cloud given!\n", getClassName().c_str());
  source_side_.reset();
  known_estimate_.reset();
  resetResult();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::setInputTarget(
    const PointCloudTargetConstPtr& cloud)
{
  if (cloud)
    Base::setInputTarget(cloud);
  else
    PCL_ERROR("[pcl::%s::setInputTarget] No cloud given!\n", getClassName().c_str());
  target_side_.reset();
  known_estimate_.reset();
  resetResult();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::setSourceFeatures(
    const FeatureCloudConstPtr& features)
{
  if (features && !features->empty())
    source_features_ = features;
  else
    PCL_ERROR("[pcl::%s::setSourceFeatures] No features given!\n",
              getClassName().c_str());
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::setTargetFeatures(
    const FeatureCloudConstPtr& features)
{
  if (features && !features->empty())
    target_features_ = features;
  else
    PCL_ERROR("[pcl::%s::setTargetFeatures] No features given!\n",
              getClassName().c_str());
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::clearFeatures()
{
  source_features_.reset();
  target_features_.reset();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
bool
FlashRegistration<PointSource, PointTarget, FeatureT>::hasInlierDistance() const
{
  // pcl::Registration's own default stands for "no limit".
  return corr_dist_threshold_ < std::sqrt(std::numeric_limits<double>::max());
}

template <typename PointSource, typename PointTarget, typename FeatureT>
PairOptions
FlashRegistration<PointSource, PointTarget, FeatureT>::pairOptions() const
{
  PairOptions options = parameters_ ? optionsWith(*parameters_) : PairOptions();
  applyMotion(options.parameters);
  if (resolution_ != 0)
    options.resolution = resolution_;
  if (hasInlierDistance())
    options.inlier_distance = static_cast<float>(corr_dist_threshold_);
  options.neighbors = static_cast<std::size_t>(k_correspondences_);
  options.cloud_check = cloud_check_;
  options.second_look = second_look_;
  return options;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
Parameters
FlashRegistration<PointSource, PointTarget, FeatureT>::getParameters() const
{
  return pairOptions().parametersFor(getResolution());
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::align(PointCloudSource& output,
                                                             const Matrix4& guess)
{
  resetResult();
  const std::string reason = whyNotCopied(output);
  if (!reason.empty())
    return fail(reason);
  // PCL hands the tree of the source to a member that wants one of the target's type.
  constexpr bool base_compiles = std::is_convertible_v<
      typename Base::KdTreeReciprocalPtr,
      typename Base::CorrespondenceEstimation::KdTreeReciprocalPtr>;
  if constexpr (base_compiles)
    Base::align(output, guess);
  else if (prepare(output))
    computeTransformation(output, guess);
}

template <typename PointSource, typename PointTarget, typename FeatureT>
std::string
FlashRegistration<PointSource, PointTarget, FeatureT>::missingInput() const
{
  if (!input_)
    return "no input source with points was given";
  return target_ ? "" : "no input target with points was given";
}

template <typename PointSource, typename PointTarget, typename FeatureT>
std::string
FlashRegistration<PointSource, PointTarget, FeatureT>::whyNotCopied(
    const PointCloudSource& output) const
{
  if (!input_ || !target_)
    return missingInput();
  if (static_cast<const void*>(&output) == target_.get())
    return "the output is the input target, which it overwrites";
  if (!indices_ || fake_indices_)
    return "";
  if (&output == input_.get())
    return "the output is the input source, while indices select points of it";
  for (const auto index : *indices_)
    if (static_cast<std::size_t>(index) >= input_->size())
      return "index " + std::to_string(index) + " is not one of a source of " +
             std::to_string(input_->size()) + " points";
  return "";
}

template <typename PointSource, typename PointTarget, typename FeatureT>
bool
FlashRegistration<PointSource, PointTarget, FeatureT>::prepare(PointCloudSource& output)
{
  if (target_cloud_updated_ && !force_no_recompute_) {
    tree_->setInputCloud(target_);
    target_cloud_updated_ = false;
  }
  if (!pcl::PCLBase<PointSource>::initCompute())
    return false;
  // In place: the output may be the source.
  output.resize(indices_->size());
  for (std::size_t i = 0; i < indices_->size(); ++i) {
    output[i] = (*input_)[(*indices_)[i]];
    output[i].data[3] = 1;
  }
  return true;
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::computeTransformation(
    PointCloudSource& output, const Matrix4& guess)
{
  const detail::Stopwatch total;
  resetResult();
  describeOutput(output);
  try {
    checkInput(output);
    PairOptions options = pairOptions();
    options.guess = hypothesisFrom(guess);
    PairResult pair = alignInputs(options);
    if (resolution_ == 0)
      estimated_resolution_ = pair.resolution;
    inlier_distance_ = pair.parameters.inlier_distance;
    timings_.matching = pair.timings.matching;
    timings_.estimation = pair.timings.estimation;
    result_ = std::move(pair.pose);
    if (result_.status == Status::Ok)
      applyResult(output);
    else
      fail(toString(result_.status) + keypointsLeft());
  }
  catch (const std::exception& error) {
    result_ = {};
    fail(error.what());
  }
  timings_.total = total.milliseconds();
}

template <typename PointSource, typename PointTarget, typename FeatureT>
void
FlashRegistration<PointSource, PointTarget, FeatureT>::checkInput(
    const PointCloudSource& output) const
{
  std::string error = whyNotCopied(output);
  if (!(inlier_fraction_ >= 0 && inlier_fraction_ <= 1))
    error = "the inlier fraction is " + detail::toText(inlier_fraction_) +
            ", it must be in [0, 1]";
  else if (k_correspondences_ <= 0)
    error = "the correspondence randomness is " + std::to_string(k_correspondences_) +
            ", it must be > 0";
  else if (!(resolution_ >= 0 && std::isfinite(resolution_)))
    error = "the resolution is " + detail::toText(resolution_) +
            ", it must be > 0 and finite, or 0 to estimate it";
  else if (indices_->empty())
    error = "no source point is selected";
  if (!error.empty())
    throw std::invalid_argument(error);
}

template <typename PointSource, typename PointTarget, typename FeatureT>
std::optional<RigidTransform>
FlashRegistration<PointSource, PointTarget, FeatureT>::hypothesisFrom(
    const Matrix4& guess)
{
  if (guess == Matrix4::Identity())
    return std::nullopt;
  const Eigen::Matrix3d rotation =
      guess.template topLeftCorner<3, 3>().template cast<double>();
  const bool rigid = guess.allFinite() && rotation.determinant() > 0 &&
                     (rotation * rotation.transpose()).isIdentity(1e-3) &&
                     guess.row(3) == Matrix4::Identity().row(3);
  if (!rigid)
    throw std::invalid_argument("the guess is not a rigid transformation");
  RigidTransform hypothesis;
  hypothesis.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  hypothesis.translation =
      guess.template topRightCorner<3, 1>().template cast<double>();
  return hypothesis;
}

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/flash_registration_matching.hpp>
#include <pcl_flashreg/impl/flash_registration_results.hpp>
