// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "methods.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/impl/stopwatch.hpp>

#include <pcl/registration/correspondence_rejection_sample_consensus.h>

#include <memory>
#include <stdexcept>

namespace pcl_flashreg::evaluate {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

Answer
runFlashreg(Estimator& estimator, const Parameters& parameters, const Input& input)
{
  const CorrespondenceView<double> view{input.source.data(),
                                        input.target.data(),
                                        input.size(),
                                        input.ranks.empty() ? nullptr
                                                            : input.ranks.data()};
  const Result result = estimator.estimate(view, parameters);
  return {result.status == Status::Ok,
          result.T_target_source,
          result.converged,
          result.inliers.size(),
          result.distinctness,
          result.timings_ms.total};
}

Cloud::Ptr
toCloud(const std::vector<double>& xyz)
{
  Cloud::Ptr cloud(new Cloud);
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3)
    cloud->emplace_back(static_cast<float>(xyz[i]),
                        static_cast<float>(xyz[i + 1]),
                        static_cast<float>(xyz[i + 2]));
  return cloud;
}

Answer
runPclRansac(int iterations, const Parameters& parameters, const Input& input)
{
  pcl::registration::CorrespondenceRejectorSampleConsensus<pcl::PointXYZ> rejector;
  rejector.setInputSource(toCloud(input.source));
  rejector.setInputTarget(toCloud(input.target));
  rejector.setInlierThreshold(parameters.inlier_distance);
  rejector.setMaximumIterations(iterations);
  rejector.setRefineModel(true);
  pcl::Correspondences all, remaining;
  for (int i = 0; i < static_cast<int>(input.size()); ++i)
    all.emplace_back(i, i, 0.0f);

  const detail::Stopwatch estimation;
  rejector.getRemainingCorrespondences(all, remaining);
  Answer answer;
  answer.estimation_ms = estimation.milliseconds();
  const Eigen::Matrix4d T = rejector.getBestTransformation().cast<double>();
  answer.found = !T.isIdentity();
  answer.trusted = answer.found;
  answer.T_target_source = {T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
  answer.inliers = remaining.size();
  return answer;
}

} // namespace

std::vector<std::string>
methodNames()
{
  return {"flashreg", "pcl_ransac_10k", "pcl_ransac_50k"};
}

Method
makeMethod(const std::string& name, const Parameters& parameters, unsigned threads)
{
  if (name == "flashreg") {
    const auto estimator = std::make_shared<Estimator>(BackendKind::Auto, threads);
    return [estimator, parameters](const Input& input) {
      return runFlashreg(*estimator, parameters, input);
    };
  }
  for (const int thousands : {10, 50})
    if (name == "pcl_ransac_" + std::to_string(thousands) + "k")
      return [thousands, parameters](const Input& input) {
        return runPclRansac(1000 * thousands, parameters, input);
      };
  throw std::invalid_argument("method " + name + " is unknown");
}

} // namespace pcl_flashreg::evaluate
