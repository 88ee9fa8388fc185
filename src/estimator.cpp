// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/estimator.h>

#include "backend.h"
#include "cpu/kernels/kernels.h"
#include "information.h"
#include "preparation.h"

#include <cmath>
#include <limits>

namespace pcl_flashreg {

struct Estimator::Impl {
  std::unique_ptr<Backend> backend;
  Trace* trace = nullptr;
  Preparation preparation;
  Problem problem;

  template <typename Scalar>
  Result
  estimate(const CorrespondenceView<Scalar>& correspondences,
           const Parameters& parameters,
           const std::optional<RigidTransform>& guess);

  Pose
  toCentred(const RigidTransform& T) const;
  RigidTransform
  toOriginal(const Pose& T) const;
  void
  fill(Result& result,
       const PoseEstimate& estimate,
       const Parameters& parameters) const;
};

namespace {

/** \brief Null where CUDA can't be used. */
std::unique_ptr<Backend>
tryCudaBackend()
{
  try {
    return makeCudaBackend();
  }
  catch (const BackendError&) {
    return nullptr;
  }
}

std::unique_ptr<Backend>
makeBackend(BackendKind kind, unsigned num_threads)
{
  if (kind == BackendKind::Cuda)
    return makeCudaBackend();
  if (kind == BackendKind::Auto)
    if (std::unique_ptr<Backend> cuda = tryCudaBackend())
      return cuda;
  return makeCpuBackend(num_threads);
}

Eigen::Matrix3d
rotationOf(const Pose& T)
{
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(T.r);
}

Eigen::Vector3d
toEigen(const Vec3& v)
{
  return {v.x, v.y, v.z};
}

template <typename Scalar>
void
checkInput(const CorrespondenceView<Scalar>& in)
{
  if (in.size > 0 && (!in.source_xyz || !in.target_xyz))
    throw std::invalid_argument("correspondences: size is " + std::to_string(in.size) +
                                ", but source_xyz or target_xyz is null");
  if (in.size > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw std::invalid_argument("correspondences: size " + std::to_string(in.size) +
                                " is out of range: it must fit an int");
}

/** \brief Inliers of the best hypothesis over those of the best other one. */
double
distinctnessOf(const std::vector<ScoredPose>& hypotheses)
{
  int runner_up = 0;
  for (std::size_t i = 1; i < hypotheses.size(); ++i)
    runner_up = std::max(runner_up, hypotheses[i].inlier_count);
  if (runner_up == 0)
    return std::numeric_limits<double>::infinity();
  return static_cast<double>(hypotheses.front().inlier_count) / runner_up;
}

} // namespace

/** \brief p_t = R p_s + t with p_s = s + c_s and p_t = q + c_t: q = R s + R c_s + t - c_t. */
Pose
Estimator::Impl::toCentred(const RigidTransform& T) const
{
  Pose centred;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(centred.r) = T.rotation;
  Eigen::Map<Eigen::Vector3d>(centred.t) =
      T.rotation * toEigen(preparation.source_centre) + T.translation -
      toEigen(preparation.target_centre);
  return centred;
}

RigidTransform
Estimator::Impl::toOriginal(const Pose& T) const
{
  RigidTransform original;
  original.rotation = rotationOf(T);
  original.translation = Eigen::Map<const Eigen::Vector3d>(T.t) +
                         toEigen(preparation.target_centre) -
                         original.rotation * toEigen(preparation.source_centre);
  return original;
}

void
Estimator::Impl::fill(Result& result,
                      const PoseEstimate& estimate,
                      const Parameters& parameters) const
{
  result.status = estimate.status;
  result.second_order = estimate.second_order;
  if (estimate.status != Status::Ok)
    return;
  for (const ScoredPose& hypothesis : estimate.hypotheses)
    result.hypotheses.push_back(
        {toOriginal(hypothesis.pose),
         hypothesis.inlier_count,
         static_cast<double>(hypothesis.score) / static_cast<double>(SCORE_UNIT)});
  result.T_target_source = result.hypotheses.front().T_target_source;
  result.score = result.hypotheses.front().score;
  for (const int i : estimate.inliers)
    result.inliers.push_back(preparation.rows[i]);
  result.distinctness = distinctnessOf(estimate.hypotheses);
  result.converged =
      static_cast<int>(result.inliers.size()) >= parameters.min_inliers &&
      result.distinctness >= parameters.min_distinctness;
  result.information = informationMatrix(problem,
                                         estimate.hypotheses.front().pose,
                                         estimate.inliers,
                                         preparation.target_centre,
                                         parameters.inlier_distance);
}

template <typename Scalar>
Result
Estimator::Impl::estimate(const CorrespondenceView<Scalar>& correspondences,
                          const Parameters& parameters,
                          const std::optional<RigidTransform>& guess)
{
  parameters.validate();
  checkInput(correspondences);
  Result result;
  result.backend = backend->name();
  StageClock clock(result.timings_ms);
  prepare(correspondences,
          static_cast<std::size_t>(parameters.max_correspondences),
          preparation,
          problem);
  result.correspondences_used = preparation.rows.size();
  result.correspondences_dropped = preparation.dropped;
  result.correspondences_invalid = preparation.invalid;
  std::optional<Pose> centred_guess;
  if (guess && guess->rotation.allFinite() && guess->translation.allFinite())
    centred_guess = toCentred(*guess);
  clock.finish(&StageTimings::preparation);

  if (problem.size >= 3)
    fill(result,
         backend->run(problem, parameters, centred_guess, clock, trace),
         parameters);
  clock.finishAll();
  return result;
}

Estimator::Estimator(BackendKind backend, unsigned num_threads)
    : impl_(std::make_unique<Impl>())
{
  impl_->backend = makeBackend(backend, num_threads);
}

Estimator::~Estimator() = default;
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator&
Estimator::operator=(Estimator&&) noexcept = default;

Result
Estimator::estimate(const CorrespondenceView<float>& correspondences,
                    const Parameters& parameters,
                    const std::optional<RigidTransform>& guess)
{
  return impl_->estimate(correspondences, parameters, guess);
}

Result
Estimator::estimate(const CorrespondenceView<double>& correspondences,
                    const Parameters& parameters,
                    const std::optional<RigidTransform>& guess)
{
  return impl_->estimate(correspondences, parameters, guess);
}

void
Estimator::setTrace(Trace* trace)
{
  impl_->trace = trace;
}

std::string
Estimator::backendName() const
{
  return impl_->backend->name();
}

std::vector<std::string>
availableBackends()
{
  std::size_t count = 0;
  const cpu::Kernels* const* kernels = cpu::availableKernels(count);
  std::vector<std::string> names;
  if (const std::unique_ptr<Backend> cuda = tryCudaBackend())
    names.push_back(cuda->name());
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(std::string("cpu-") + kernels[i]->name);
  return names;
}

const char*
version()
{
  return PCL_FLASHREG_VERSION;
}

const char*
toString(Status status)
{
  switch (status) {
  case Status::Ok:
    return "pose found";
  case Status::TooFewCorrespondences:
    return "fewer than three usable correspondences";
  case Status::NoClique:
    return "no three correspondences preserve their mutual distances";
  case Status::Degenerate:
    return "the consistent correspondences are collinear, coincident, or fewer than "
           "three "
           "agree with any pose";
  }
  return "unknown status";
}

} // namespace pcl_flashreg
