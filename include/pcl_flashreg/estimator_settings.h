// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/impl/lazy_registration.hpp>

#include <optional>

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
  detail::LazyRegistration registration_;
};

} // namespace pcl_flashreg
