// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// This project's estimator.

#include "families.h"

#include <pcl_flashreg/estimator.h>

#include <memory>

namespace pcl_flashreg::evaluate {
namespace {

Answer
run(Estimator& estimator, const Parameters& parameters, const Correspondences& given)
{
  const CorrespondenceView<double> view{given.source.data(),
                                        given.target.data(),
                                        given.size(),
                                        given.ranks.empty() ? nullptr
                                                            : given.ranks.data()};
  const Result result = estimator.estimate(view, parameters);
  Answer answer;
  answer.found = result.status == Status::Ok;
  answer.T_target_source = result.T_target_source;
  answer.trusted = result.converged;
  answer.confidence = result.distinctness;
  answer.inliers = result.inliers.size();
  answer.estimation_ms = result.timings_ms.total;
  answer.stages_ms = result.timings_ms;
  return answer;
}

MethodEntry
entry(const std::string& name,
      const std::string& description,
      BackendKind backend,
      SecondOrder second_order)
{
  const auto make = [=](const MethodSettings& settings) {
    Parameters parameters = settings.parameters;
    parameters.second_order = second_order;
    const auto estimator = std::make_shared<Estimator>(backend, settings.threads);
    return [=](const Problem& problem) {
      return run(*estimator, parameters, problem.correspondences);
    };
  };
  return {name, description, false, make};
}

} // namespace

std::vector<MethodEntry>
flashregMethods()
{
  return {entry("flashreg",
                "this project, the best backend that runs here",
                BackendKind::Auto,
                SecondOrder::Auto),
          entry("flashreg_exact",
                "the same on the CPU, exact second-order graph",
                BackendKind::Cpu,
                SecondOrder::Exact),
          entry("flashreg_bounded",
                "the same on the CPU, bounded second-order graph",
                BackendKind::Cpu,
                SecondOrder::Bounded),
          entry("flashreg_cuda",
                "the same on CUDA, where it is built in and a device is there",
                BackendKind::Cuda,
                SecondOrder::Auto)};
}

} // namespace pcl_flashreg::evaluate
