// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The order of the steps, from wherever a caller enters.

#include <pcl_flashreg/pair_registration.h>

#include "registration/other_matches.h"
#include "registration/pair_call.h"
#include "registration/side_by_side.h"
#include "scan/points.h"

#include <mutex>
#include <stdexcept>

namespace pcl_flashreg {
namespace {

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

class PairRegistration::Impl : public PairWorkers {
public:
  Impl(BackendKind backend, unsigned num_threads)
      : PairWorkers(backend, num_threads),
        batch(*this, search.pool(), search.pool().size())
  {
  }

  SideBySide<PairWorkers> batch;
};

PairRegistration::PairRegistration(BackendKind backend, unsigned num_threads)
    : impl_(std::make_unique<Impl>(backend, num_threads))
{
}

PairRegistration::~PairRegistration() = default;
PairRegistration::PairRegistration(PairRegistration&&) noexcept = default;
PairRegistration&
PairRegistration::operator=(PairRegistration&&) noexcept = default;

template <typename Scalar>
PairResult
PairRegistration::align(const ScanInput<Scalar>& source,
                        const ScanInput<Scalar>& target,
                        const PairOptions& options)
{
  PairCall call(*impl_, options);
  checkBothOrNone(source.features, target.features);
  const PreparedInput from(source), to(target);
  call.chooseResolution(from, to);
  call.makeScans(from, to, ScanContent::Descriptors);
  call.match();
  call.estimateFromMatches();
  return call.finish();
}

PairResult
PairRegistration::align(const Scan& source,
                        const Scan& target,
                        const PairOptions& options)
{
  return alignScans(*impl_, source, target, options);
}

std::vector<PairResult>
PairRegistration::alignBatch(const std::vector<PairOfScans>& pairs,
                             const PairOptions& options)
{
  std::vector<PairResult> results(pairs.size());
  std::mutex reporting;
  PairOptions of_one = options;
  if (options.on_step)
    of_one.on_step = [&](const PairProgress& progress) {
      const std::lock_guard lock(reporting);
      options.on_step(progress);
    };
  impl_->batch.forEach(pairs.size(), [&](PairWorkers& workers, std::size_t i) {
    results[i] = alignScans(workers, pairs[i].source, pairs[i].target, of_one);
  });
  return results;
}

PairResult
PairRegistration::align(const Scan& source,
                        const ScanIndex& target,
                        const PairOptions& options)
{
  PairCall call(*impl_, options);
  call.takeScans(source, target.scan(), &target.data());
  call.match();
  call.estimateFromMatches();
  return call.finish();
}

ScanIndex
PairRegistration::makeIndex(const Scan& scan)
{
  return makeScanIndex(scan, impl_->maker, impl_->search.pool());
}

PairResult
PairRegistration::align(const Scan& source,
                        const Scan& target,
                        const std::vector<FeatureMatch>& matches,
                        const PairOptions& options)
{
  PairCall call(*impl_, options);
  call.takeScans(source, target);
  call.takeMatches(matches);
  call.estimateFromMatches();
  return call.finish();
}

template <typename Scalar>
PairResult
PairRegistration::align(const ScanInput<Scalar>& source,
                        const ScanInput<Scalar>& target,
                        const CorrespondenceView<Scalar>& correspondences,
                        const PairOptions& options)
{
  PairCall call(*impl_, options);
  call.chooseResolution(correspondences);
  const bool has_clouds = countOf(source.points) > 0 && countOf(target.points) > 0;
  if (options.cloud_check && has_clouds && call.result().resolution != 0)
    call.makeScans(PreparedInput(source), PreparedInput(target), ScanContent::Surface);
  call.estimateFrom(correspondences);
  return call.finish();
}

PairResult
PairRegistration::align(const Scan& source,
                        const Scan& target,
                        const CorrespondenceView<double>& correspondences,
                        const PairOptions& options)
{
  PairCall call(*impl_, options);
  call.takeScans(source, target);
  call.estimateFrom(correspondences);
  return call.finish();
}

template <typename Scalar>
Scan
PairRegistration::makeScan(const ScanInput<Scalar>& input,
                           double resolution,
                           ScanContent content,
                           FeatureTimings* timings)
{
  FeatureTimings spent;
  const Scan scan = impl_->maker.make(PreparedInput(input), resolution, content, spent);
  if (timings)
    *timings = spent;
  return scan;
}

template <typename Scalar>
double
PairRegistration::chooseResolution(const ScanInput<Scalar>& source,
                                   const ScanInput<Scalar>& target) const
{
  const PairOptions options;
  PairCall call(*impl_, options);
  call.chooseResolution(PreparedInput(source), PreparedInput(target));
  return call.result().resolution;
}

std::vector<FeatureMatch>
PairRegistration::match(const Scan& source,
                        const Scan& target,
                        const PairOptions& options)
{
  return matchScans(source, target, options, impl_->search.pool());
}

std::string
PairRegistration::backendName() const
{
  return impl_->search.backendName();
}

#define PCL_FLASHREG_INSTANTIATE(Scalar)                                               \
  template PairResult PairRegistration::align(                                         \
      const ScanInput<Scalar>&, const ScanInput<Scalar>&, const PairOptions&);         \
  template PairResult PairRegistration::align(const ScanInput<Scalar>&,                \
                                              const ScanInput<Scalar>&,                \
                                              const CorrespondenceView<Scalar>&,       \
                                              const PairOptions&);                     \
  template Scan PairRegistration::makeScan(                                            \
      const ScanInput<Scalar>&, double, ScanContent, FeatureTimings*);                 \
  template double PairRegistration::chooseResolution(const ScanInput<Scalar>&,         \
                                                     const ScanInput<Scalar>&) const;
PCL_FLASHREG_INSTANTIATE(float)
PCL_FLASHREG_INSTANTIATE(double)
#undef PCL_FLASHREG_INSTANTIATE

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

} // namespace pcl_flashreg
