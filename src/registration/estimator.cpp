// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/estimator.h>

#include "estimation/backend.h"
#include "judgement/cloud_check.h"
#include "judgement/cpu/plane_alignment.h"
#include "judgement/confidence.h"
#include "simd/kernels.h"
#include "judgement/evidence.h"
#include "estimation/information.h"
#include "estimation/preparation.h"

#include <cmath>
#include <limits>

namespace pcl_flashreg {

struct Estimator::Impl {
  Impl(std::unique_ptr<Backend> chosen, unsigned num_threads)
      : backend(std::move(chosen)), pool(num_threads)
  {
  }

  std::unique_ptr<Backend> backend;
  ThreadPool pool;
  Trace* trace = nullptr;
  Preparation preparation;
  Problem problem;
  Surface source_surface, target_surface;

  template <typename Scalar>
  Result
  estimate(const CorrespondenceView<Scalar>& correspondences,
           const Parameters& parameters,
           const std::optional<RigidTransform>& guess,
           const CloudPairView<Scalar>* clouds);

  template <typename Scalar>
  SurfacePair
  prepareClouds(const CloudPairView<Scalar>& clouds);
  void
  askClouds(const SurfacePair& clouds,
            const Parameters& parameters,
            PoseEstimate& estimate,
            CloudFindings& findings);

  Pose
  toCentred(const RigidTransform& T) const;
  RigidTransform
  toOriginal(const Pose& T) const;
  void
  fill(Result& result,
       const PoseEstimate& estimate,
       const CloudFindings& findings,
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

template <typename Scalar>
void
checkInput(const CloudPairView<Scalar>& clouds)
{
  for (const CloudView<Scalar>* cloud : {&clouds.source, &clouds.target})
    if (cloud->size > 0 && (!cloud->xyz || !cloud->normals))
      throw std::invalid_argument("clouds: size is " + std::to_string(cloud->size) +
                                  ", but xyz or normals is null");
  if (!(clouds.spacing > 0) || !std::isfinite(clouds.spacing))
    throw std::invalid_argument("clouds: spacing = " + std::to_string(clouds.spacing) +
                                " is out of range: it must be a finite length > 0");
}

/** \brief Hypotheses that the verdict needs to see: rivals for the correspondences, and
 * more of them where the clouds choose. */
constexpr int LISTED = 5, LISTED_FOR_CLOUDS = 20;

Parameters
withRivals(Parameters parameters, bool for_clouds)
{
  parameters.max_hypotheses =
      std::max(parameters.max_hypotheses, for_clouds ? LISTED_FOR_CLOUDS : LISTED);
  return parameters;
}

/** \brief The most inliers that a hypothesis other than the first has. */
int
rivalInliers(const std::vector<ScoredPose>& hypotheses)
{
  int most = 0;
  for (std::size_t i = 1; i < hypotheses.size(); ++i)
    most = std::max(most, hypotheses[i].inlier_count);
  return most;
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

template <typename Scalar>
SurfacePair
Estimator::Impl::prepareClouds(const CloudPairView<Scalar>& clouds)
{
  const auto spacing = static_cast<float>(clouds.spacing);
  pool.forEach(2, [&](std::size_t side, std::size_t) {
    if (side == 0)
      source_surface.build(clouds.source, preparation.source_centre, spacing);
    else
      target_surface.build(clouds.target, preparation.target_centre, spacing);
  });
  return {source_surface, target_surface, spacing};
}

/** \brief Replaces the hypotheses by those that stand before the clouds, unless the best
 * of these has less than three inliers. */
void
Estimator::Impl::askClouds(const SurfacePair& clouds,
                           const Parameters& parameters,
                           PoseEstimate& estimate,
                           CloudFindings& findings)
{
  const float limit = parameters.inlier_distance;
  findings = checkOnClouds(
      clouds, problem, estimate.candidates, estimate.hypotheses, limit, pool);
  if (findings.evidence.inliers < 3) {
    findings = {};
    return;
  }
  estimate.hypotheses.clear();
  for (const CheckedPose& checked : findings.poses) {
    std::vector<int> inliers = inliersOf(problem, checked.pose, limit);
    estimate.hypotheses.push_back({checked.pose,
                                   scoreOf(problem, checked.pose, inliers, parameters),
                                   checked.inlier_count});
    if (estimate.hypotheses.size() == 1)
      estimate.inliers = std::move(inliers);
  }
}

void
Estimator::Impl::fill(Result& result,
                      const PoseEstimate& estimate,
                      const CloudFindings& findings,
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
         static_cast<double>(hypothesis.score) / static_cast<double>(SCORE_UNIT),
         std::nullopt});
  result.T_target_source = result.hypotheses.front().T_target_source;
  result.score = result.hypotheses.front().score;
  for (const int i : estimate.inliers)
    result.inliers.push_back(preparation.rows[i]);
  const int rival = rivalInliers(estimate.hypotheses);
  result.distinctness = rival > 0 ? static_cast<double>(estimate.inliers.size()) / rival
                                  : std::numeric_limits<double>::infinity();
  result.evidence = findings.evidence;
  addCorrespondences(
      problem, estimate.inliers, rival, parameters.inlier_distance, result.evidence);
  for (std::size_t i = 0; i < findings.poses.size(); ++i)
    result.hypotheses[i].agreement = findings.poses[i].agreement;
  result.hypotheses.resize(
      std::min<std::size_t>(result.hypotheses.size(), parameters.max_hypotheses));
  result.confidence = confidenceOf(result.evidence);
  result.converged = result.confidence >= parameters.min_confidence;
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
                          const std::optional<RigidTransform>& guess,
                          const CloudPairView<Scalar>* clouds)
{
  parameters.validate();
  checkInput(correspondences);
  if (clouds)
    checkInput(*clouds);
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

  if (problem.size >= 3) {
    // Only with viewpoints can the clouds tell which of thousands of poses is right.
    const bool screen = clouds && clouds->source.viewpoint && clouds->target.viewpoint;
    PoseEstimate estimate = backend->run(problem,
                                         withRivals(parameters, clouds != nullptr),
                                         centred_guess,
                                         screen,
                                         clock,
                                         trace);
    CloudFindings findings;
    if (clouds && estimate.status == Status::Ok)
      askClouds(prepareClouds(*clouds), parameters, estimate, findings);
    fill(result, estimate, findings, parameters);
    clock.finish(&StageTimings::cloud_check);
  }
  clock.finishAll();
  return result;
}

Estimator::Estimator(BackendKind backend, unsigned num_threads)
    : impl_(std::make_unique<Impl>(makeBackend(backend, num_threads), num_threads))
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
  return impl_->estimate(correspondences, parameters, guess, clouds);
}

Result
Estimator::estimate(const CorrespondenceView<double>& correspondences,
                    const Parameters& parameters,
                    const std::optional<RigidTransform>& guess,
                    const CloudPairView<double>* clouds)
{
  return impl_->estimate(correspondences, parameters, guess, clouds);
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
