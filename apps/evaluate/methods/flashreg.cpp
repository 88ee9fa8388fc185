// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// This project's estimator.

#include "families.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/impl/cloud_buffer.hpp>

#include <memory>
#include <optional>

namespace pcl_flashreg::evaluate {
namespace {

/** \brief What is known of the clouds is told to the estimator. */
enum class Clouds { Ignored, WithoutViewpoints, WithViewpoints };

/** \brief A method's estimator, and room for the clouds of the pair at hand. */
class Flashreg {
public:
  Flashreg(BackendKind backend, Clouds clouds, const MethodSettings& settings)
      : estimator_(backend, settings.threads),
        clouds_(clouds),
        parameters_(settings.parameters),
        leaf_(settings.leaf)
  {
  }

  void
  setSecondOrder(SecondOrder second_order)
  {
    parameters_.second_order = second_order;
  }

  Answer
  run(const Problem& problem)
  {
    const Correspondences& given = problem.correspondences;
    const CorrespondenceView<double> view{given.source.data(),
                                          given.target.data(),
                                          given.size(),
                                          given.ranks.empty() ? nullptr
                                                              : given.ranks.data()};
    CloudPairView<double> clouds;
    const bool ask = clouds_ != Clouds::Ignored && problem.source && problem.target;
    if (ask)
      clouds = {
          viewOf(*problem.source, source_), viewOf(*problem.target, target_), leaf_};
    const Result result =
        estimator_.estimate(view, parameters_, std::nullopt, ask ? &clouds : nullptr);
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
  CloudView<double>
  viewOf(const DescribedCloud& cloud, detail::CloudBuffer<double>& buffer) const
  {
    std::optional<Eigen::Vector3d> viewpoint;
    if (clouds_ == Clouds::WithViewpoints && cloud.viewpoint.allFinite())
      viewpoint = cloud.viewpoint;
    buffer.gather(cloud.keypoints, cloud.shift, viewpoint);
    return buffer.view();
  }

  Estimator estimator_;
  Clouds clouds_;
  Parameters parameters_;
  double leaf_;
  detail::CloudBuffer<double> source_, target_;
};

MethodEntry
entry(const std::string& name,
      const std::string& description,
      BackendKind backend,
      Clouds clouds,
      SecondOrder second_order = SecondOrder::Auto)
{
  const auto make = [=](const MethodSettings& settings) {
    const auto method = std::make_shared<Flashreg>(backend, clouds, settings);
    method->setSecondOrder(second_order);
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
