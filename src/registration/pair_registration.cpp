// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/pair_registration.h>

#include "matching/search.h"
#include "registration/pose_search.h"
#include "scan/scan_maker.h"

#include <pcl_flashreg/resolution.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Runs a step, and books its time. */
template <typename Step>
auto
timed(double& milliseconds, const Step& step)
{
  const detail::Stopwatch watch;
  struct Booking {
    const detail::Stopwatch& watch;
    double& milliseconds;
    ~Booking()
    {
      milliseconds += watch.milliseconds();
    }
  } booking{watch, milliseconds};
  return step();
}

/** \brief Nothing, if the points are too few to tell. */
template <typename Scalar>
std::optional<double>
spacingOf(const Scalar* xyz, std::size_t size)
{
  ScanInput<Scalar> input;
  input.points.data = xyz;
  input.points.size = size;
  try {
    return estimateVoxelSize(PreparedInput(input).points);
  }
  catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

JudgingCloud
judgeFrom(const Scan& scan)
{
  CloudView<float> view{scan.points(), scan.normals(), scan.size(), std::nullopt};
  if (scan.viewpoint())
    view.viewpoint = *scan.viewpoint() - scan.shift();
  return {view, {scan.shift().x(), scan.shift().y(), scan.shift().z()}};
}

/** \brief Descriptors of the caller's on one side don't match those of the other. */
void
checkBothOrNone(const FeatureView& source, const FeatureView& target)
{
  if ((source.dimension == 0) != (target.dimension == 0))
    throw std::invalid_argument(std::string("descriptors were given of the ") +
                                (source.dimension == 0 ? "target" : "source") +
                                " alone");
}

} // namespace

Parameters
PairOptions::parametersFor(double voxel_size) const
{
  const Parameters lengths =
      voxel_size != 0 ? Parameters::fromResolution(voxel_size) : Parameters();
  Parameters result = parameters;
  result.length_tolerance = length_tolerance.value_or(lengths.length_tolerance);
  result.min_length_sum = min_length_sum.value_or(lengths.min_length_sum);
  result.inlier_distance = inlier_distance.value_or(lengths.inlier_distance);
  return result;
}

Correspondences
toCorrespondences(const Scan& source,
                  const Scan& target,
                  const std::vector<FeatureMatch>& matches)
{
  Correspondences result;
  result.source.reserve(3 * matches.size());
  result.target.reserve(3 * matches.size());
  result.ranks.reserve(matches.size());
  for (const FeatureMatch& match : matches) {
    const Eigen::Vector3d s = source.point(static_cast<std::size_t>(match.query));
    const Eigen::Vector3d t = target.point(static_cast<std::size_t>(match.match));
    result.source.insert(result.source.end(), s.data(), s.data() + 3);
    result.target.insert(result.target.end(), t.data(), t.data() + 3);
    result.ranks.push_back(match.squared_distance);
  }
  return result;
}

/** \brief One call after the other; what a call finds out is in `out`. */
class PairRegistration::Impl {
public:
  Impl(BackendKind backend, unsigned num_threads)
      : search(backend, num_threads), maker(search.pool())
  {
  }

  PoseSearch search;
  ScanMaker maker;

  template <typename Scalar>
  PairResult
  align(const ScanInput<Scalar>& source,
        const ScanInput<Scalar>& target,
        const PairOptions& options);
  template <typename Scalar>
  PairResult
  align(const ScanInput<Scalar>& source,
        const ScanInput<Scalar>& target,
        const CorrespondenceView<Scalar>& correspondences,
        const PairOptions& options);
  void
  takeScans(const Scan& source,
            const Scan& target,
            const PairOptions& options,
            PairResult& out) const;

  void
  begin(const PairOptions& options, PairResult& out, PairStep step) const
  {
    if (!options.on_step)
      return;
    options.on_step({step,
                     out.resolution,
                     out.source.size(),
                     out.target.size(),
                     out.correspondences});
  }

  std::vector<FeatureMatch>
  match(const Scan& source, const Scan& target, const PairOptions& options)
  {
    const MutualMatches matches = searchFeatures(source.features(),
                                                 target.features(),
                                                 options.neighbors,
                                                 options.mutual,
                                                 search.pool());
    return options.mutual ? matches.mutual() : matches.forward;
  }

  /** \brief The coarser of both. */
  void
  chooseResolution(const PreparedInput& source,
                   const PreparedInput& target,
                   const PairOptions& options,
                   PairResult& out) const
  {
    if (options.resolution) {
      out.resolution = *options.resolution;
      return;
    }
    begin(options, out, PairStep::Resolution);
    timed(out.timings.resolution, [&] {
      out.source_estimate = estimateResolution(source);
      out.target_estimate = estimateResolution(target);
    });
    out.resolution = std::max(*out.source_estimate, *out.target_estimate);
  }

  /** \brief The finer of both: that of the side with more distinct points. */
  template <typename Scalar>
  void
  chooseResolution(const CorrespondenceView<Scalar>& correspondences,
                   const PairOptions& options,
                   PairResult& out) const
  {
    if (options.resolution) {
      out.resolution = *options.resolution;
      return;
    }
    begin(options, out, PairStep::Resolution);
    timed(out.timings.resolution, [&] {
      const auto source = spacingOf(correspondences.source_xyz, correspondences.size);
      const auto target = spacingOf(correspondences.target_xyz, correspondences.size);
      if (source && target)
        out.resolution = std::min(*source, *target);
    });
  }

  void
  makeScans(const PreparedInput& source,
            const PreparedInput& target,
            ScanContent content,
            const PairOptions& options,
            PairResult& out)
  {
    begin(options, out, PairStep::SourceScan);
    out.source = maker.make(source, out.resolution, content, out.timings.source);
    begin(options, out, PairStep::TargetScan);
    out.target = maker.make(target, out.resolution, content, out.timings.target);
  }

  template <typename Scalar>
  void
  estimate(const CorrespondenceView<Scalar>& correspondences,
           const PairOptions& options,
           PairResult& out)
  {
    out.correspondences = correspondences.size;
    begin(options, out, PairStep::Estimation);
    out.parameters = options.parametersFor(out.resolution);
    const JudgingClouds clouds{
        judgeFrom(out.source), judgeFrom(out.target), out.resolution};
    const bool ask = options.cloud_check && !out.source.empty() && !out.target.empty();
    out.pose = search.run(
        correspondences, out.parameters, options.guess, ask ? &clouds : nullptr);
    out.timings.estimation = out.pose.timings_ms;
  }

  /** \brief From the scans in `out` to the pose. */
  void
  alignScans(const PairOptions& options, PairResult& out)
  {
    begin(options, out, PairStep::Matching);
    const Correspondences correspondences = timed(out.timings.matching, [&] {
      out.matches = match(out.source, out.target, options);
      return toCorrespondences(out.source, out.target, out.matches);
    });
    estimate(correspondences.view(), options, out);
  }
};

namespace {

/** \brief The result of some steps, with the time that they took together. */
template <typename Steps>
PairResult
resultOf(const Steps& steps)
{
  PairResult out;
  const detail::Stopwatch total;
  steps(out);
  out.timings.total = total.milliseconds();
  return out;
}

template <typename Scalar>
bool
hasPoints(const ScanInput<Scalar>& input)
{
  return input.points.indices ? input.points.index_count > 0 : input.points.size > 0;
}

} // namespace

PairRegistration::PairRegistration(BackendKind backend, unsigned num_threads)
    : impl_(std::make_unique<Impl>(backend, num_threads))
{
}

PairRegistration::~PairRegistration() = default;
PairRegistration::PairRegistration(PairRegistration&&) noexcept = default;
PairRegistration&
PairRegistration::operator=(PairRegistration&&) noexcept = default;

Scan
PairRegistration::makeScan(const ScanInput<float>& input,
                           double resolution,
                           ScanContent content,
                           FeatureTimings* timings)
{
  FeatureTimings spent;
  return impl_->maker.make(
      PreparedInput(input), resolution, content, timings ? *timings : spent);
}

Scan
PairRegistration::makeScan(const ScanInput<double>& input,
                           double resolution,
                           ScanContent content,
                           FeatureTimings* timings)
{
  FeatureTimings spent;
  return impl_->maker.make(
      PreparedInput(input), resolution, content, timings ? *timings : spent);
}

double
PairRegistration::chooseResolution(const ScanInput<float>& source,
                                   const ScanInput<float>& target) const
{
  PairResult out;
  impl_->chooseResolution(PreparedInput(source), PreparedInput(target), {}, out);
  return out.resolution;
}

double
PairRegistration::chooseResolution(const ScanInput<double>& source,
                                   const ScanInput<double>& target) const
{
  PairResult out;
  impl_->chooseResolution(PreparedInput(source), PreparedInput(target), {}, out);
  return out.resolution;
}

std::vector<FeatureMatch>
PairRegistration::match(const Scan& source,
                        const Scan& target,
                        const PairOptions& options)
{
  return impl_->match(source, target, options);
}

/** \brief Clouds, scans, matches, the pose. */
template <typename Scalar>
PairResult
PairRegistration::Impl::align(const ScanInput<Scalar>& source,
                              const ScanInput<Scalar>& target,
                              const PairOptions& options)
{
  return resultOf([&](PairResult& out) {
    checkBothOrNone(source.features, target.features);
    const PreparedInput from(source), to(target);
    chooseResolution(from, to, options, out);
    makeScans(from, to, ScanContent::Descriptors, options, out);
    alignScans(options, out);
  });
}

/** \brief Correspondences, surfaces of the clouds, the pose. */
template <typename Scalar>
PairResult
PairRegistration::Impl::align(const ScanInput<Scalar>& source,
                              const ScanInput<Scalar>& target,
                              const CorrespondenceView<Scalar>& correspondences,
                              const PairOptions& options)
{
  return resultOf([&](PairResult& out) {
    chooseResolution(correspondences, options, out);
    const bool ask = options.cloud_check && out.resolution != 0 && hasPoints(source) &&
                     hasPoints(target);
    if (ask)
      makeScans(PreparedInput(source),
                PreparedInput(target),
                ScanContent::Surface,
                options,
                out);
    estimate(correspondences, options, out);
  });
}

/** \brief Scans of which the coarser one sets the resolution. */
void
PairRegistration::Impl::takeScans(const Scan& source,
                                  const Scan& target,
                                  const PairOptions& options,
                                  PairResult& out) const
{
  out.source = source;
  out.target = target;
  out.resolution =
      options.resolution.value_or(std::max(source.spacing(), target.spacing()));
}

PairResult
PairRegistration::align(const ScanInput<float>& source,
                        const ScanInput<float>& target,
                        const PairOptions& options)
{
  return impl_->align(source, target, options);
}

PairResult
PairRegistration::align(const ScanInput<double>& source,
                        const ScanInput<double>& target,
                        const PairOptions& options)
{
  return impl_->align(source, target, options);
}

PairResult
PairRegistration::align(const ScanInput<float>& source,
                        const ScanInput<float>& target,
                        const CorrespondenceView<float>& correspondences,
                        const PairOptions& options)
{
  return impl_->align(source, target, correspondences, options);
}

PairResult
PairRegistration::align(const ScanInput<double>& source,
                        const ScanInput<double>& target,
                        const CorrespondenceView<double>& correspondences,
                        const PairOptions& options)
{
  return impl_->align(source, target, correspondences, options);
}

PairResult
PairRegistration::align(const Scan& source,
                        const Scan& target,
                        const PairOptions& options)
{
  return resultOf([&](PairResult& out) {
    impl_->takeScans(source, target, options, out);
    impl_->alignScans(options, out);
  });
}

PairResult
PairRegistration::align(const Scan& source,
                        const Scan& target,
                        const CorrespondenceView<double>& correspondences,
                        const PairOptions& options)
{
  return resultOf([&](PairResult& out) {
    impl_->takeScans(source, target, options, out);
    impl_->estimate(correspondences, options, out);
  });
}

std::string
PairRegistration::backendName() const
{
  return impl_->search.backendName();
}

} // namespace pcl_flashreg
