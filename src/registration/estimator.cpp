// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/estimator.h>

#include "registration/exchange.h"
#include "registration/pose_search.h"
#include "support/require.h"

#include <cmath>
#include <stdexcept>
#include <utility>

namespace pcl_flashreg {
namespace {

template <typename Scalar>
void
checkInput(const CloudPairView<Scalar>& clouds)
{
  for (const CloudView<Scalar>* cloud : {&clouds.source, &clouds.target})
    if (cloud->size > 0 && (!cloud->xyz || !cloud->normals))
      throw std::invalid_argument("clouds: size is " + std::to_string(cloud->size) +
                                  ", but xyz or normals is null");
  require(clouds.spacing > 0 && std::isfinite(clouds.spacing),
          "clouds: spacing",
          clouds.spacing,
          "it must be a finite length > 0");
}

template <typename Scalar>
Result
run(PoseSearch& search,
    const CorrespondenceView<Scalar>& correspondences,
    const Parameters& parameters,
    const std::optional<RigidTransform>& guess,
    const CloudPairView<Scalar>* clouds)
{
  parameters.validate();
  if (!clouds)
    return search.run(correspondences, parameters, guess, nullptr);
  checkInput(*clouds);
  if (!Vicinity::isMuchLarger(clouds->source.size, clouds->target.size)) {
    const JudgingClouds judges{
        JudgingCloud(clouds->source), JudgingCloud(clouds->target), clouds->spacing};
    return search.run(correspondences, parameters, guess, &judges);
  }
  // A scan is looked for in a map, whichever of them is the source.
  const JudgingClouds judges{
      JudgingCloud(clouds->target), JudgingCloud(clouds->source), clouds->spacing};
  CorrespondenceView<Scalar> there_and_back = correspondences;
  std::swap(there_and_back.source_xyz, there_and_back.target_xyz);
  std::optional<RigidTransform> guess_back;
  if (guess)
    guess_back = inverseOf(*guess);
  Result result =
      search.run(there_and_back, exchanged(parameters), guess_back, &judges);
  exchange(result);
  return result;
}

} // namespace

struct Estimator::Impl {
  PoseSearch search;
};

Estimator::Estimator(BackendKind backend, unsigned num_threads)
    : impl_(new Impl{{backend, num_threads}})
{
}

Estimator::~Estimator() = default;
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator&
Estimator::operator=(Estimator&&) noexcept = default;

Result
Estimator::estimate(const CorrespondenceView<float>& correspondences,
                    const Parameters& parameters,
                    const std::optional<RigidTransform>& guess,
                    const CloudPairView<float>* clouds)
{
  return run(impl_->search, correspondences, parameters, guess, clouds);
}

Result
Estimator::estimate(const CorrespondenceView<double>& correspondences,
                    const Parameters& parameters,
                    const std::optional<RigidTransform>& guess,
                    const CloudPairView<double>* clouds)
{
  return run(impl_->search, correspondences, parameters, guess, clouds);
}

void
Estimator::setTrace(Trace* trace)
{
  impl_->search.setTrace(trace);
}

std::string
Estimator::backendName() const
{
  return impl_->search.backendName();
}

const char*
version()
{
  return PCL_FLASHREG_VERSION;
}

} // namespace pcl_flashreg
