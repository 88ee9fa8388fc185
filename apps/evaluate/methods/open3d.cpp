// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Open3D's RANSAC and Fast Global Registration, on the given correspondences, with the
// settings of its tutorial "Global registration". Both work on all threads that OpenMP has
// (OMP_NUM_THREADS): with more than one, RANSAC's answers vary from run to run.

#include "families.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <open3d/geometry/PointCloud.h>
#include <open3d/pipelines/registration/CorrespondenceChecker.h>
#include <open3d/pipelines/registration/FastGlobalRegistration.h>
#include <open3d/pipelines/registration/Registration.h>
#include <open3d/utility/Logging.h>
#include <open3d/utility/Random.h>

namespace pcl_flashreg::evaluate {
namespace {

namespace o3d = open3d::pipelines::registration;
using open3d::geometry::PointCloud;

/** \brief The two sides; row i of both is correspondence i. */
struct Sides {
  PointCloud source, target;
  o3d::CorrespondenceSet correspondences;

  explicit Sides(const Correspondences& given)
  {
    for (std::size_t i = 0; i < given.size(); ++i) {
      source.points_.emplace_back(&given.source[3 * i]);
      target.points_.emplace_back(&given.target[3 * i]);
      correspondences.emplace_back(static_cast<int>(i), static_cast<int>(i));
    }
  }
};

Answer
toAnswer(const o3d::RegistrationResult& result, double milliseconds)
{
  const Eigen::Matrix4d T = result.transformation_;
  Answer answer;
  answer.estimation_ms = milliseconds;
  answer.found = !T.isIdentity();
  answer.trusted = answer.found;
  answer.T_target_source = {T.topLeftCorner<3, 3>(), T.topRightCorner<3, 1>()};
  answer.inliers = result.correspondence_set_.size();
  answer.confidence = result.fitness_;
  return answer;
}

Answer
runRansac(double leaf, const Correspondences& given)
{
  const Sides sides(given);
  const double distance = 1.5 * leaf;
  const o3d::CorrespondenceCheckerBasedOnEdgeLength edge_length(0.9);
  const o3d::CorrespondenceCheckerBasedOnDistance residual(distance);
  open3d::utility::random::Seed(1);
  const detail::Stopwatch estimation;
  const auto result = o3d::RegistrationRANSACBasedOnCorrespondence(
      sides.source,
      sides.target,
      sides.correspondences,
      distance,
      o3d::TransformationEstimationPointToPoint(false),
      3,
      {edge_length, residual},
      o3d::RANSACConvergenceCriteria(100000, 0.999));
  return toAnswer(result, estimation.milliseconds());
}

Answer
runFastGlobal(double leaf, const Correspondences& given)
{
  const Sides sides(given);
  o3d::FastGlobalRegistrationOption option;
  option.maximum_correspondence_distance_ = 0.5 * leaf;
  open3d::utility::random::Seed(1);
  const detail::Stopwatch estimation;
  const auto result = o3d::FastGlobalRegistrationBasedOnCorrespondence(
      sides.source, sides.target, sides.correspondences, option);
  return toAnswer(result, estimation.milliseconds());
}

template <typename Run>
MethodEntry
entry(const std::string& name, const std::string& description, Run run)
{
  return {name, description, false, [run](const MethodSettings& settings) {
            open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
            const double leaf = settings.leaf;
            return [run, leaf](const Problem& problem) {
              return run(leaf, problem.correspondences);
            };
          }};
}

} // namespace

std::vector<MethodEntry>
open3dMethods()
{
  return {entry("open3d_ransac",
                "Open3D's RANSAC on correspondences, 100,000 iterations at most, edge "
                "length and distance checked; OpenMP's threads",
                runRansac),
          entry("open3d_fgr", "Open3D's Fast Global Registration", runFastGlobal)};
}

} // namespace pcl_flashreg::evaluate
