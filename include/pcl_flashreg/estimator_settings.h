// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/impl/lazy_registration.hpp>

#include <Eigen/Core>

#include <optional>
#include <utility>

namespace pcl_flashreg {

/** \brief How the pose is estimated: the settings that the PCL classes have in common. */
class EstimatorSettings {
public:
  /** \brief The voxel size, in the unit of the clouds; 0 (the default) where it is not
   * known: the class says what is done then. */
  void
  setResolution(double resolution)
  {
    resolution_ = resolution;
  }

  /** \brief All the parameters of the estimator, their lengths included, whatever the
   * resolution: start from Parameters::fromResolution() to change only some.
   * std::nullopt (the default) to take the lengths from the resolution. */
  void
  setParameters(const std::optional<Parameters>& parameters)
  {
    parameters_ = parameters;
  }

  /** \brief Which motions a pose may be, whatever setParameters() says of it:
   * MotionModel::Rigid by default, or MotionModel::Upright where it is known which way is
   * up. */
  void
  setMotion(MotionModel motion)
  {
    motion_ = motion;
  }

  /** \brief Upright motion: the directions of gravity in the frames of source and target, or
   * the opposite ones of both, of any length > 0; (0, 0, 1) by default. Holds whatever
   * setParameters() says of it. One that can't be is reported by the computation. Of many
   * clouds each is a source or a target: both are the same for these. */
  void
  setGravity(const Eigen::Vector3d& source, const Eigen::Vector3d& target)
  {
    gravity_ = {source.cast<float>(), target.cast<float>()};
  }

  /** \brief Upright motion: how many degrees gravity may be off under the pose, > 0 and
   * <= 30; 3 by default. Holds whatever setParameters() says of it. */
  void
  setMaxTilt(double degrees)
  {
    max_tilt_ = static_cast<float>(degrees);
  }

  /** \brief CPU threads of every part; 0 (the default) for all. */
  void
  setNumberOfThreads(unsigned num_threads)
  {
    registration_.configure(registration_.backend(), num_threads);
  }

  /** \brief Where the stages of the estimator run; BackendKind::Auto by default. */
  void
  setBackend(BackendKind backend)
  {
    registration_.configure(backend, registration_.numThreads());
  }

protected:
  /** \brief What was said of the motion takes the place of what the parameters say. */
  void
  applyMotion(Parameters& parameters) const
  {
    parameters.motion = motion_.value_or(parameters.motion);
    parameters.max_tilt = max_tilt_.value_or(parameters.max_tilt);
    if (!gravity_)
      return;
    const auto& [source, target] = *gravity_;
    parameters.source_gravity = {source.x(), source.y(), source.z()};
    parameters.target_gravity = {target.x(), target.y(), target.z()};
  }

  /** \brief With these parameters, whatever the resolution. */
  static PairOptions
  optionsWith(const Parameters& parameters)
  {
    PairOptions options;
    options.parameters = parameters;
    options.length_tolerance = parameters.length_tolerance;
    options.min_length_sum = parameters.min_length_sum;
    options.inlier_distance = parameters.inlier_distance;
    return options;
  }

  EstimatorSettings() = default;
  ~EstimatorSettings() = default;
  EstimatorSettings(const EstimatorSettings&) = default;
  EstimatorSettings&
  operator=(const EstimatorSettings&) = default;

  double resolution_ = 0;
  std::optional<Parameters> parameters_;
  std::optional<MotionModel> motion_;
  std::optional<float> max_tilt_;
  std::optional<std::pair<Eigen::Vector3f, Eigen::Vector3f>> gravity_;
  detail::LazyRegistration registration_;
};

} // namespace pcl_flashreg
