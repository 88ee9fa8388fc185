// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/feature_extractor.h>

#include "scan/cpu/feature_stages.h"
#include "scan/points.h"
#include "support/require.h"

#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief A length that single precision can square. */
bool
isLength(double value)
{
  return value > 1e-18 && value < 1e18;
}

} // namespace

FeatureParameters
FeatureParameters::fromResolution(double resolution)
{
  require(isLength(resolution),
          "resolution",
          resolution,
          "it must be > 0 and finite, and so must its square in single precision");
  FeatureParameters parameters;
  parameters.voxel_size = resolution;
  parameters.normal_radius = 2 * resolution;
  parameters.feature_radius = 5 * resolution;
  return parameters;
}

void
FeatureParameters::validate() const
{
  require(voxel_size == 0 || isLength(voxel_size),
          "voxel_size",
          voxel_size,
          "it must be 0 or a finite length > 0");
  require(isLength(normal_radius),
          "normal_radius",
          normal_radius,
          "it must be a finite length > 0");
  require(isLength(feature_radius) && feature_radius >= normal_radius,
          "feature_radius",
          feature_radius,
          "it must be a finite length >= normal_radius");
  for (const float coordinate : viewpoint)
    require(std::isfinite(coordinate), "viewpoint", coordinate, "it must be finite");
}

class FeatureExtractor::Impl {
public:
  explicit Impl(unsigned num_threads)
      : pool(num_threads), stages(cpu::selectKernels(), pool)
  {
  }

  ThreadPool pool;
  cpu::FeatureStages stages;
};

FeatureExtractor::FeatureExtractor(unsigned num_threads)
    : impl_(std::make_unique<Impl>(num_threads))
{
}

FeatureExtractor::~FeatureExtractor() = default;
FeatureExtractor::FeatureExtractor(FeatureExtractor&&) noexcept = default;
FeatureExtractor&
FeatureExtractor::operator=(FeatureExtractor&&) noexcept = default;

DescribedCloud
FeatureExtractor::describe(const PointView& points,
                           const FeatureParameters& parameters,
                           FeatureTimings* timings)
{
  check(points);
  parameters.validate();
  FeatureTimings spent;
  cpu::FeatureStages& stages = impl_->stages;
  findSurface(stages, points, {}, parameters, ScanContent::Descriptors, spent);
  stages.turnNormals(Eigen::Map<const Eigen::Vector3f>(parameters.viewpoint), true);
  describeSurface(stages, parameters, spent);
  if (timings)
    *timings = spent;
  return stages.takeResult(ScanContent::Descriptors, false);
}

} // namespace pcl_flashreg
