// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// This project's registration.

#include "families.h"

#include <memory>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief What is known of the clouds is told to the estimator. */
enum class Clouds { Ignored, WithoutViewpoints, WithSourceViewpoint, WithViewpoints };

/** \brief A method's registration, and how it is told to go about. */
class Flashreg {
public:
  Flashreg(BackendKind backend,
           Clouds clouds,
           SecondOrder second_order,
           const MethodSettings& settings)
      : registration_(backend, settings.threads), clouds_(clouds)
  {
    options_.resolution = settings.leaf;
    options_.parameters = settings.parameters;
    options_.parameters.second_order = second_order;
    options_.cloud_check = clouds != Clouds::Ignored;
  }

  Answer
  run(const Problem& problem)
  {
    const Scan source = told(problem.source, clouds_ >= Clouds::WithSourceViewpoint);
    const Scan target = told(problem.target, clouds_ == Clouds::WithViewpoints);
    const Result result =
        problem.matches.empty()
            ? registration_
                  .align(source, target, problem.correspondences.view(), options_)
                  .pose
            : registration_.align(source, target, problem.matches, options_).pose;
    Answer answer;
    answer.found = result.status == Status::Ok;
    answer.T_target_source = result.T_target_source;
    answer.trusted = result.converged;
    answer.confidence = result.confidence;
    answer.inliers = result.inliers.size();
    answer.evidence = result.evidence;
    answer.estimation_ms = result.timings_ms.total;
    answer.stages_ms = result.timings_ms;
    return answer;
  }

private:
  static Scan
  told(const Scan& scan, bool with_viewpoint)
  {
    return with_viewpoint ? scan : scan.withoutViewpoint();
  }

  PairRegistration registration_;
  Clouds clouds_;
  PairOptions options_;
};

MethodEntry
entry(const std::string& name,
      const std::string& description,
      BackendKind backend,
      Clouds clouds,
      SecondOrder second_order = SecondOrder::Auto)
{
  const auto make = [=](const MethodSettings& settings) {
    const auto method =
        std::make_shared<Flashreg>(backend, clouds, second_order, settings);
    return [=](const Problem& problem) { return method->run(problem); };
  };
  return {name, description, false, make};
}

} // namespace

std::vector<MethodEntry>
flashregMethods()
{
  return {
      entry(
          "flashreg",
          "this project, the best backend that runs here; clouds are asked where known",
          BackendKind::Auto,
          Clouds::WithViewpoints),
      {"flashreg_map",
       "the same, all clouds of a scene at a time, which make a map",
       true,
       {},
       true},
      entry("flashreg_source_viewpoint",
            "the same, but nobody knows where the sensor of the target stood",
            BackendKind::Auto,
            Clouds::WithSourceViewpoint),
      entry("flashreg_no_viewpoint",
            "the same, but nobody knows where the sensors stood",
            BackendKind::Auto,
            Clouds::WithoutViewpoints),
      entry("flashreg_fast",
            "the same from the correspondences alone",
            BackendKind::Auto,
            Clouds::Ignored),
      entry("flashreg_exact",
            "flashreg_fast on the CPU, exact second-order graph",
            BackendKind::Cpu,
            Clouds::Ignored,
            SecondOrder::Exact),
      entry("flashreg_bounded",
            "flashreg_fast on the CPU, bounded second-order graph",
            BackendKind::Cpu,
            Clouds::Ignored,
            SecondOrder::Bounded),
      entry("flashreg_cuda",
            "flashreg_fast on CUDA, where it is built in and a device is there",
            BackendKind::Cuda,
            Clouds::Ignored)};
}

} // namespace pcl_flashreg::evaluate
