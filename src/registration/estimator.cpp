// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/estimator.h>

#include "estimation/check_correspondences.h"
#include "registration/exchange.h"
#include "registration/pose_search.h"
#include "registration/side_by_side.h"
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

/** \brief Streams that share a device: so many were measured, and each made it faster. */
constexpr std::size_t STREAMS = 8;

struct Estimator::Impl {
  Impl(BackendKind backend, unsigned num_threads)
      : search(backend, num_threads),
        batch(
            search, search.pool(), search.isOnDevice() ? STREAMS : search.pool().size())
  {
  }

  template <typename Scalar>
  std::vector<Result>
  estimateBatch(const std::vector<CorrespondenceView<Scalar>>& problems,
                const Parameters& parameters)
  {
    parameters.validate();
    for (std::size_t i = 0; i < problems.size(); ++i)
      checkCorrespondences(problems[i],
                           "correspondences of problem " + std::to_string(i));
    std::vector<Result> results(problems.size());
    batch.forEach(problems.size(), [&](PoseSearch& worker, std::size_t i) {
      results[i] = worker.run(problems[i], parameters, std::nullopt, nullptr);
    });
    return results;
  }

  PoseSearch search;
  SideBySide<PoseSearch> batch;
};

Estimator::Estimator(BackendKind backend, unsigned num_threads)
    : impl_(new Impl(backend, num_threads))
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

Result
Estimator::estimate(const DeviceCorrespondences& correspondences,
                    const Parameters& parameters,
                    const std::optional<RigidTransform>& guess)
{
  parameters.validate();
  checkCorrespondences(correspondences);
  const CorrespondenceView<float> copies = impl_->search.readBack(correspondences);
  Result result = estimate(copies, parameters, guess);
  if (correspondences.T_target_source) {
    using Matrix = Eigen::Matrix<float, 4, 4, Eigen::RowMajor>;
    const Matrix T = result.T_target_source.toMatrix<float>();
    impl_->search.leavePose(T.data(), correspondences);
  }
  return result;
}

std::vector<Result>
Estimator::estimateBatch(const std::vector<CorrespondenceView<float>>& problems,
                         const Parameters& parameters)
{
  return impl_->estimateBatch(problems, parameters);
}

std::vector<Result>
Estimator::estimateBatch(const std::vector<CorrespondenceView<double>>& problems,
                         const Parameters& parameters)
{
  return impl_->estimateBatch(problems, parameters);
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
