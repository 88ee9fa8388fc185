// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/pair_call.h"

#include "localization/places.h"
#include "registration/exchange.h"
#include "registration/other_matches.h"
#include "scan/scan_view.h"

#include <pcl_flashreg/resolution.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace pcl_flashreg {
namespace {

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

/** \brief The coarser of both; of a cloud and one that is a part of it, that of the part,
 * since nobody asks for more detail than that has. Beyond that they are not in one unit. */
double
resolutionFor(const CloudScale& a, const CloudScale& b)
{
  constexpr double A_PART = 2, NOT_ONE_UNIT = 30;
  const CloudScale &finer = a.resolution < b.resolution ? a : b,
                   &coarser = a.resolution < b.resolution ? b : a;
  const double ratio = coarser.resolution / finer.resolution;
  return ratio > A_PART && ratio < NOT_ONE_UNIT &&
                 A_PART * finer.extent < coarser.extent
             ? finer.resolution
             : coarser.resolution;
}

JudgingCloud
judgeFrom(const Scan& scan, const ScanIndex::Data* index)
{
  JudgingCloud cloud(viewOf(scan), shiftOf(scan));
  if (index) {
    cloud.surface = &index->surface;
    cloud.spacing = scan.spacing();
    cloud.known_middle = index->middle;
  }
  return cloud;
}

} // namespace

void
PairCall::begin(PairStep step) const
{
  if (!options_.on_step)
    return;
  PairProgress at{step,
                  result_.resolution,
                  result_.source.size(),
                  result_.target.size(),
                  result_.correspondences};
  if (exchanged_)
    std::swap(at.source_keypoints, at.target_keypoints);
  options_.on_step(at);
}

void
PairCall::chooseResolution(const PreparedInput& source, const PreparedInput& target)
{
  if (options_.resolution) {
    result_.resolution = *options_.resolution;
    return;
  }
  begin(PairStep::Resolution);
  const detail::Stopwatch watch;
  // Keypoints with descriptors have the size of their voxels.
  const auto scale = [](const PreparedInput& input) {
    return input.features.dimension > 0 ? CloudScale{estimateVoxelSize(input.points), 0}
                                        : scaleOf(input.points);
  };
  const CloudScale of_source = scale(source), of_target = scale(target);
  result_.source_estimate = of_source.resolution;
  result_.target_estimate = of_target.resolution;
  result_.resolution = resolutionFor(of_source, of_target);
  result_.timings.resolution = watch.milliseconds();
}

template <typename Scalar>
void
PairCall::chooseResolution(const CorrespondenceView<Scalar>& correspondences)
{
  if (options_.resolution) {
    result_.resolution = *options_.resolution;
    return;
  }
  begin(PairStep::Resolution);
  const detail::Stopwatch watch;
  const auto source = spacingOf(correspondences.source_xyz, correspondences.size);
  const auto target = spacingOf(correspondences.target_xyz, correspondences.size);
  if (source && target)
    result_.resolution = std::min(*source, *target);
  result_.timings.resolution = watch.milliseconds();
}

template void
PairCall::chooseResolution(const CorrespondenceView<float>&);
template void
PairCall::chooseResolution(const CorrespondenceView<double>&);

void
PairCall::makeScans(const PreparedInput& source,
                    const PreparedInput& target,
                    ScanContent content)
{
  const double resolution = result_.resolution;
  result_.source_left_out = source.left_out;
  result_.target_left_out = target.left_out;
  PairTimings& timings = result_.timings;
  begin(PairStep::SourceScan);
  result_.source = workers_.maker.make(source, resolution, content, timings.source);
  begin(PairStep::TargetScan);
  result_.target = workers_.maker.make(target, resolution, content, timings.target);
  exchangeIfMap();
}

void
PairCall::takeScans(const Scan& source,
                    const Scan& target,
                    const ScanIndex::Data* index)
{
  result_.source = source;
  result_.target = target;
  result_.resolution =
      options_.resolution.value_or(std::max(source.spacing(), target.spacing()));
  if (isMapFor(target, source))
    index_ = index;
  exchangeIfMap();
}

void
PairCall::exchangeIfMap()
{
  exchanged_ = isMapFor(result_.source, result_.target);
  if (exchanged_)
    std::swap(result_.source, result_.target);
}

void
PairCall::match()
{
  begin(PairStep::Matching);
  const detail::Stopwatch watch;
  ThreadPool& pool = workers_.search.pool();
  const Scan &source = result_.source, &target = result_.target;
  result_.matches =
      index_ && !options_.mutual
          ? matchInMap(source, target, &index_->features, options_.neighbors, pool)
          : matchScans(source, target, options_, pool);
  result_.timings.matching = watch.milliseconds();
}

void
PairCall::takeMatches(const std::vector<FeatureMatch>& matches)
{
  const std::size_t sources = (exchanged_ ? result_.target : result_.source).size();
  const std::size_t targets = (exchanged_ ? result_.source : result_.target).size();
  const auto isRow = [](std::int32_t row, std::size_t count) {
    return row >= 0 && static_cast<std::size_t>(row) < count;
  };
  for (const FeatureMatch& match : matches)
    if (!isRow(match.query, sources) || !isRow(match.match, targets))
      throw std::invalid_argument("match of keypoints " + std::to_string(match.query) +
                                  " and " + std::to_string(match.match) +
                                  ": the scans have " + std::to_string(sources) +
                                  " and " + std::to_string(targets));
  result_.matches = matches;
  if (exchanged_)
    exchange(result_.matches);
}

void
PairCall::estimateFromMatches()
{
  const Correspondences correspondences =
      toCorrespondences(result_.source, result_.target, result_.matches);
  if (!options_.second_look || options_.mutual)
    return estimate(correspondences.view(), {});
  OtherMatches others({result_.source, result_.target, index_}, options_, workers_);
  estimate(correspondences.view(), [&](std::size_t i) { return others.get(i); });
}

template <typename Scalar>
void
PairCall::estimateFrom(CorrespondenceView<Scalar> correspondences)
{
  if (exchanged_)
    std::swap(correspondences.source_xyz, correspondences.target_xyz);
  estimate(correspondences, {});
}

template void PairCall::estimateFrom(CorrespondenceView<float>);
template void PairCall::estimateFrom(CorrespondenceView<double>);

template <typename Scalar>
void
PairCall::estimate(const CorrespondenceView<Scalar>& correspondences,
                   const SecondLook& second_look)
{
  result_.correspondences = correspondences.size;
  begin(PairStep::Estimation);
  result_.parameters = options_.parametersFor(result_.resolution);
  const JudgingClouds clouds{judgeFrom(result_.source, nullptr),
                             judgeFrom(result_.target, index_),
                             result_.resolution,
                             options_.give_up_early};
  const bool ask =
      options_.cloud_check && !result_.source.empty() && !result_.target.empty();
  result_.pose = workers_.search.run(
      correspondences,
      exchanged_ ? exchanged(result_.parameters) : result_.parameters,
      exchanged_ && options_.guess ? inverseOf(*options_.guess) : options_.guess,
      ask ? &clouds : nullptr,
      second_look);
  result_.timings.estimation = result_.pose.timings_ms;
}

PairResult
PairCall::finish()
{
  if (exchanged_) {
    std::swap(result_.source, result_.target);
    exchange(result_.matches);
    exchange(result_.pose);
  }
  result_.timings.total = total_.milliseconds();
  return std::move(result_);
}

PairResult
alignScans(PairWorkers& workers,
           const Scan& source,
           const Scan& target,
           const PairOptions& options)
{
  PairCall call(workers, options);
  call.takeScans(source, target);
  call.match();
  call.estimateFromMatches();
  return call.finish();
}

} // namespace pcl_flashreg
