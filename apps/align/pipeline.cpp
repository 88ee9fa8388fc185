// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pipeline.h"

#include "../io/error.h"
#include "../io/pcl_cloud.h"
#include "../io/scan_input.h"
#include "doubts.h"
#include "modules.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>

#include <algorithm>

namespace pcl_flashreg::align {
namespace {

using io::InputError;

/** \brief A cloud as a registration takes it. */
ScanInput<double>
scanInput(const std::optional<InputCloud>& cloud,
          const std::optional<InputFeatures>& features,
          bool viewpoint_known)
{
  if (!cloud)
    return {};
  ScanInput<double> input = io::scanInput(cloud->cloud, cloud->xyz, viewpoint_known);
  if (features)
    input.features = {features->values.data(),
                      features->values.size() / features->dimension,
                      features->dimension,
                      features->dimension};
  return input;
}

/** \brief Keypoints that PCL's classes made, in the place of their cloud. */
class PclKeypoints {
public:
  PclKeypoints(const ScanInput<double>& cloud,
               const Eigen::Matrix3Xd& xyz,
               double resolution,
               unsigned threads,
               FeatureTimings& timings)
      : input_(cloud)
  {
    const io::ShiftedCloud shifted = io::toPclCloud(xyz);
    if (shifted.shift.isZero(0) || !cloud.viewpoint.isZero(0))
      shifted.points->sensor_origin_.head<3>() =
          (cloud.viewpoint - shifted.shift).cast<float>();
    FpfhTimings spent;
    loadPclFeatures()(*shifted.points, resolution, threads, spent, fpfh_);
    timings.voxel_grid = spent.voxel_grid;
    timings.normals = spent.normals;
    timings.feature_histograms = spent.features;
    for (const auto& point : *fpfh_.points) {
      const Eigen::Vector3d p = point.getVector3fMap().cast<double>() + shifted.shift;
      xyz_.insert(xyz_.end(), p.data(), p.data() + 3);
    }
    input_.points = {xyz_.data(), fpfh_.points->size(), 3, nullptr, 0};
    input_.normals = fpfh_.normals->empty() ? nullptr : (*fpfh_.normals)[0].normal;
    input_.normal_stride = sizeof(pcl::Normal) / sizeof(float);
    input_.features = detail::viewOf(*fpfh_.features);
  }

  const ScanInput<double>&
  input() const
  {
    return input_;
  }

private:
  FpfhCloud fpfh_;
  std::vector<double> xyz_;
  ScanInput<double> input_;
};

/** \brief One run: what it is made from, and what people are told on the way. */
class Run {
public:
  Run(const Options& options, const Inputs& inputs, const Messages& messages)
      : options_(options),
        inputs_(inputs),
        messages_(messages),
        source_(scanInput(
            inputs.source, inputs.source_features, options.source_viewpoint_known)),
        target_(scanInput(
            inputs.target, inputs.target_features, options.target_viewpoint_known))
  {
  }

  PairResult
  align(PairRegistration& registration)
  {
    PairOptions options = options_.pairOptions();
    options.guess = inputs_.guess;
    options.on_step = [&](const PairProgress& at) { tell(at); };
    try {
      if (options_.pcl_features)
        return alignPclKeypoints(registration, options);
      if (inputs_.correspondences) {
        const io::Correspondences& given = *inputs_.correspondences;
        const CorrespondenceView<double> view{
            given.source.data(), given.target.data(), given.size(), nullptr};
        return registration.align(source_, target_, view, options);
      }
      return registration.align(source_, target_, options);
    }
    catch (const std::invalid_argument& error) {
      complain(error.what());
    }
  }

private:
  PairResult
  alignPclKeypoints(PairRegistration& registration, PairOptions options)
  {
    if (!options.resolution)
      options.resolution = registration.chooseResolution(source_, target_);
    options.on_step = [&](const PairProgress& at) {
      if (at.step >= PairStep::Matching)
        tell(at);
    };
    FeatureTimings source_time, target_time;
    const auto describe = [&](const ScanInput<double>& cloud,
                              const InputCloud& input,
                              PairStep step,
                              FeatureTimings& time) {
      tell({step, *options.resolution});
      return PclKeypoints(
          cloud, input.xyz, *options.resolution, options_.threads, time);
    };
    const auto source =
        describe(source_, *inputs_.source, PairStep::SourceScan, source_time);
    const auto target =
        describe(target_, *inputs_.target, PairStep::TargetScan, target_time);
    PairResult result = registration.align(source.input(), target.input(), options);
    result.timings.source = source_time;
    result.timings.target = target_time;
    return result;
  }

  void
  tell(const PairProgress& at)
  {
    step_ = at.step;
    switch (at.step) {
    case PairStep::Resolution:
      return messages_.say("estimating the resolution");
    case PairStep::SourceScan:
      return messages_.say("describing the source, voxels of " +
                           detail::toText(at.resolution));
    case PairStep::TargetScan:
      return messages_.say("describing the target");
    case PairStep::Matching:
      requireKeypoints(*inputs_.source, at.source_keypoints, at.resolution);
      requireKeypoints(*inputs_.target, at.target_keypoints, at.resolution);
      warnOfLongMatching(at.source_keypoints, at.target_keypoints);
      return messages_.say("matching");
    case PairStep::Estimation:
      return messages_.say("estimating the pose from " +
                           std::to_string(at.correspondences) + " correspondences");
    }
  }

  void
  requireKeypoints(const InputCloud& cloud,
                   std::size_t keypoints,
                   double resolution) const
  {
    constexpr std::size_t NEEDED = 12;
    if (keypoints >= NEEDED || inputs_.source_features)
      return;
    const std::string left =
        keypoints == 0 ? "no point" : "only " + std::to_string(keypoints) + " points";
    const std::string problem = "leaves " + left +
                                " that can be described, while a trusted pose takes " +
                                std::to_string(NEEDED);
    if (options_.leaf)
      failLeaf(cloud, problem);
    throw InputError(cloud.path + ": the voxel grid of " + detail::toText(resolution) +
                     " " + problem +
                     " (--leaf sets another; are both clouds in the same unit?)");
  }

  /** \brief Matching grows faster than the number of keypoints, unless many are described
   * alike, which nobody knows before. */
  void
  warnOfLongMatching(std::size_t sources, std::size_t targets) const
  {
    // Some ten seconds on two cores, going by 266 k with 254 k keypoints in 1.4 s.
    constexpr double MANY_PAIRS = 5e11;
    if (static_cast<double>(sources) * static_cast<double>(targets) > MANY_PAIRS)
      messages_.note("matching " + std::to_string(sources) + " with " +
                     std::to_string(targets) +
                     " keypoints may take long; a larger --leaf leaves fewer of them");
  }

  /** \brief Complains about a leaf that was given, and says which would suit. */
  [[noreturn]] void
  failLeaf(const InputCloud& cloud, const std::string& problem) const
  {
    const double better = resolutionOf(cloud);
    throw UsageError("--leaf " + detail::toText(*options_.leaf) + ": " + problem +
                     "; about " + detail::toText(better) + " would suit " + cloud.path);
  }

  static bool
  hasResolution(const InputCloud& cloud)
  {
    try {
      return resolutionOf(cloud) > 0;
    }
    catch (const std::invalid_argument&) {
      return false;
    }
  }

  /** \brief What the core can't work with, in terms of what was given here. */
  [[noreturn]] void
  complain(const std::string& problem) const
  {
    if (step_ == PairStep::Matching || step_ == PairStep::Estimation)
      throw InputError(problem);
    const bool of_source =
        step_ == PairStep::SourceScan ||
        (step_ == PairStep::Resolution && !hasResolution(*inputs_.source));
    const InputCloud& cloud = of_source ? *inputs_.source : *inputs_.target;
    if (options_.leaf)
      failLeaf(cloud, problem);
    throw InputError(cloud.path + ": " + problem);
  }

  const Options& options_;
  const Inputs& inputs_;
  const Messages& messages_;
  ScanInput<double> source_, target_;
  PairStep step_ = PairStep::Resolution;
};

} // namespace

Outcome
alignInputs(const Options& options, const Inputs& inputs, const Messages& messages)
{
  const detail::Stopwatch setup;
  PairRegistration registration(options.backend, options.threads);
  Outcome outcome;
  outcome.setup_ms = setup.milliseconds();
  outcome.pair = Run(options, inputs, messages).align(registration);
  noteDoubts(options, inputs, outcome.pair, messages);
  return outcome;
}

std::vector<Step>
stepsOf(const Outcome& outcome)
{
  const PairTimings& t = outcome.pair.timings;
  const auto both = [&](double FeatureTimings::*step) {
    return t.source.*step + t.target.*step;
  };
  // Without clouds this is the time of the verdict alone.
  const double cloud_check =
      outcome.pair.pose.evidence.has_clouds ? t.estimation.cloud_check : 0;
  std::vector<Step> steps = {
      {"reading", outcome.reading_ms},
      {"setup", outcome.setup_ms},
      {"resolution", t.resolution},
      {"voxel grid", both(&FeatureTimings::voxel_grid)},
      {"normals",
       both(&FeatureTimings::neighbor_grid) + both(&FeatureTimings::normals)},
      {"features",
       both(&FeatureTimings::point_histograms) +
           both(&FeatureTimings::feature_histograms)},
      {"matching", t.matching},
      {"pose", t.estimation.total - cloud_check - t.estimation.second_look, true},
      {"cloud check", cloud_check, true},
      {"second look", t.estimation.second_look, true}};
  double rest = outcome.total_ms;
  for (const Step& step : steps)
    rest -= step.milliseconds;
  steps.push_back({"copying", rest});
  return steps;
}

} // namespace pcl_flashreg::align
