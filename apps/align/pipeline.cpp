// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pipeline.h"

#include "../io/error.h"
#include "../io/pcl_cloud.h"
#include "matching.h"
#include "modules.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/impl/cloud_buffer.hpp>

#include <sstream>

namespace pcl_flashreg::align {
namespace {

using io::InputError;

std::string
shortNumber(double value)
{
  std::ostringstream text;
  text << value;
  return text.str();
}

/** \brief A cloud ready for PCL. */
struct Side {
  const InputCloud& input;
  io::ShiftedCloud shifted;

  /** \brief Frame of the file. Nothing where the cloud lies so far from the origin that
   * no sensor can have stood there, which is what a file without one says. */
  std::optional<Eigen::Vector3d> viewpoint;

  explicit Side(const InputCloud& cloud)
      : input(cloud), shifted(io::toPclCloud(cloud.xyz))
  {
    const Eigen::Vector3d stated(cloud.cloud.viewpoint.data());
    if (!shifted.shift.isZero(0) && stated.isZero(0))
      return;
    viewpoint = stated;
    shifted.points->sensor_origin_.head<3>() = (stated - shifted.shift).cast<float>();
  }
};

/** \brief What the estimator works on. */
struct Matched {
  RankedCorrespondences correspondences;
  detail::CloudBuffer<double> source, target;
  /** \brief Of the two clouds; nothing where they have no say. */
  std::optional<CloudPairView<double>> clouds;
};

using Estimate = double (*)(const pcl::PointCloud<pcl::PointXYZ>& points,
                            const pcl::Indices& indices);

struct Resolutions {
  double source, target;

  double
  coarser() const
  {
    return std::max(source, target);
  }
};

Resolutions
estimateBoth(const Side& source, const Side& target, Estimate estimate)
{
  const auto resolutionOf = [&](const Side& side) {
    try {
      return estimate(*side.shifted.points, {});
    }
    catch (const std::invalid_argument& error) {
      throw InputError(side.input.path + ": " + error.what());
    }
  };
  return {resolutionOf(source), resolutionOf(target)};
}

void
askForTheUnit(const Resolutions& estimated, const Progress& progress)
{
  constexpr double FAR_APART = 5;
  if (estimated.coarser() > FAR_APART * std::min(estimated.source, estimated.target))
    progress.note("the source by itself would be seen at a resolution of " +
                  shortNumber(estimated.source) + ", the target at " +
                  shortNumber(estimated.target) + ": are both in the same unit?");
}

/** \brief Complains about a leaf that was given, and says which would suit. */
[[noreturn]] void
failLeaf(const Side& side, double leaf, const std::string& problem)
{
  const double better = estimateResolution(*side.shifted.points);
  throw UsageError("--leaf " + shortNumber(leaf) + ": " + problem + "; about " +
                   shortNumber(better) + " would suit " + side.input.path);
}

struct Keypoints {
  Eigen::Matrix3Xd xyz;
  FpfhCloud described;
};

Keypoints
describe(const Side& side,
         const Options& options,
         const Outcome& outcome,
         FeatureExtractor& extractor,
         StepClock& clock)
{
  Keypoints keypoints;
  FpfhTimings timings;
  try {
    const auto& points = *side.shifted.points;
    if (options.pcl_features)
      loadPclFeatures()(
          points, *outcome.resolution, options.threads, timings, keypoints.described);
    else
      keypoints.described =
          computeFpfh(points, {}, *outcome.resolution, extractor, &timings);
  }
  catch (const std::invalid_argument& error) {
    if (options.leaf)
      failLeaf(side, *options.leaf, error.what());
    throw InputError(side.input.path + ": " + error.what());
  }
  const auto& points = *keypoints.described.points;
  constexpr std::size_t needed = 12;
  if (points.size() < needed) {
    const std::string left = points.empty()
                                 ? "no point"
                                 : "only " + std::to_string(points.size()) + " points";
    const std::string problem = "leaves " + left +
                                " that can be described, while a trusted pose takes " +
                                std::to_string(needed);
    if (options.leaf)
      failLeaf(side, *options.leaf, problem);
    throw InputError(side.input.path + ": the voxel grid of " +
                     shortNumber(*outcome.resolution) + " " + problem +
                     " (--leaf sets another; are both clouds in the same unit?)");
  }
  keypoints.xyz.resize(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    keypoints.xyz.col(static_cast<Eigen::Index>(i)) =
        points[i].getVector3fMap().cast<double>() + side.shifted.shift;
  clock.book(&Times::voxel_grid, timings.voxel_grid);
  clock.book(&Times::normals, timings.normals);
  clock.book(&Times::features, timings.features);
  clock.finish(&Times::copying);
  return keypoints;
}

FeatureView
viewOf(const pcl::PointCloud<pcl::FPFHSignature33>& features)
{
  constexpr std::size_t dimension = 33;
  static_assert(sizeof(pcl::FPFHSignature33) == dimension * sizeof(float));
  return {features[0].histogram, features.size(), dimension, dimension};
}

FeatureView
viewOf(const InputFeatures& features)
{
  return {features.values.data(),
          features.values.size() / features.dimension,
          features.dimension,
          features.dimension};
}

/** \brief Matching grows faster than the number of keypoints. */
void
warnOfLongMatching(const Keypoints& source,
                   const Keypoints& target,
                   const Progress& progress)
{
  // Some ten seconds on two cores, going by 266 k with 254 k keypoints in 1.4 s.
  constexpr double MANY_PAIRS = 5e11;
  const auto sources = source.xyz.cols(), targets = target.xyz.cols();
  if (static_cast<double>(sources) * static_cast<double>(targets) > MANY_PAIRS)
    progress.note("matching " + std::to_string(sources) + " with " +
                  std::to_string(targets) +
                  " keypoints takes long; a larger --leaf leaves fewer of them");
}

void
gatherClouds(const Side& source,
             const FpfhCloud& from,
             const Side& target,
             const FpfhCloud& to,
             double resolution,
             bool viewpoints_known,
             Matched& matched)
{
  const auto viewpoint = [&](const Side& side) {
    return viewpoints_known ? side.viewpoint : std::nullopt;
  };
  matched.source.gather(from, source.shifted.shift, viewpoint(source));
  matched.target.gather(to, target.shifted.shift, viewpoint(target));
  matched.clouds =
      CloudPairView<double>{matched.source.view(), matched.target.view(), resolution};
}

void
matchClouds(const Options& options,
            const Inputs& inputs,
            const Progress& progress,
            StepClock& clock,
            Outcome& outcome,
            Matched& matched)
{
  const Side source(*inputs.source);
  const Side target(*inputs.target);
  clock.finish(&Times::copying);
  const auto match = [&](const auto&... points_and_features) {
    progress.say("matching");
    matched.correspondences = matchPoints(
        points_and_features..., options.neighbors, options.mutual, options.threads);
    clock.finish(&Times::matching);
  };
  std::optional<Resolutions> estimated;
  if (!options.leaf)
    estimated =
        estimateBoth(source,
                     target,
                     inputs.source_features ? &estimateVoxelSize<pcl::PointXYZ>
                                            : &estimateResolution<pcl::PointXYZ>);
  outcome.resolution = estimated ? estimated->coarser() : *options.leaf;
  clock.finish(&Times::resolution);
  if (inputs.source_features) {
    match(source.input.xyz,
          viewOf(*inputs.source_features),
          target.input.xyz,
          viewOf(*inputs.target_features));
    return;
  }
  FeatureExtractor extractor(options.threads);
  progress.say("describing the source, voxels of " + shortNumber(*outcome.resolution));
  const Keypoints from = describe(source, options, outcome, extractor, clock);
  progress.say("describing the target");
  const Keypoints to = describe(target, options, outcome, extractor, clock);
  if (estimated)
    askForTheUnit(*estimated, progress);
  warnOfLongMatching(from, to, progress);
  match(from.xyz,
        viewOf(*from.described.features),
        to.xyz,
        viewOf(*to.described.features));
  if (!options.fast)
    gatherClouds(source,
                 from.described,
                 target,
                 to.described,
                 *outcome.resolution,
                 options.viewpoints_known,
                 matched);
  clock.finish(&Times::copying);
}

/** \brief For given correspondences: --leaf, or the voxel size of their own points, of
 * the side with more distinct ones. Nothing if they are too few to tell. */
std::optional<double>
resolutionFor(const Options& options, const io::Correspondences& given)
{
  if (options.leaf)
    return options.leaf;
  try {
    return std::min(estimateVoxelSize(*io::toPclCloud(given.source).points),
                    estimateVoxelSize(*io::toPclCloud(given.target).points));
  }
  catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

} // namespace

Outcome
alignInputs(const Options& options,
            const Inputs& inputs,
            const Progress& progress,
            StepClock& clock)
{
  Estimator estimator(options.backend, options.threads);
  clock.finish(&Times::setup);
  Outcome outcome;
  Matched matched;
  if (inputs.correspondences) {
    outcome.resolution = resolutionFor(options, *inputs.correspondences);
    clock.finish(&Times::resolution);
  }
  else {
    matchClouds(options, inputs, progress, clock, outcome, matched);
  }
  const std::vector<float>& ranks = matched.correspondences.ranks;
  const io::Correspondences& given =
      inputs.correspondences ? *inputs.correspondences : matched.correspondences.points;
  outcome.correspondences = given.size();
  outcome.parameters = options.parametersFor(outcome.resolution);
  progress.say("estimating the pose from " + std::to_string(given.size()) +
               " correspondences");
  const CorrespondenceView<double> view{given.source.data(),
                                        given.target.data(),
                                        given.size(),
                                        ranks.empty() ? nullptr : ranks.data()};
  outcome.result = estimator.estimate(view,
                                      outcome.parameters,
                                      inputs.guess,
                                      matched.clouds ? &*matched.clouds : nullptr);
  const StageTimings& stages = outcome.result.timings_ms;
  clock.book(&Times::pose, stages.total - stages.cloud_check);
  clock.book(&Times::cloud_check, stages.cloud_check);
  clock.finish(&Times::copying);
  outcome.times = clock.times();
  return outcome;
}

} // namespace pcl_flashreg::align
