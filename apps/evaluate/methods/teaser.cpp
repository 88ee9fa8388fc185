// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// TEASER++ on the given correspondences, with the settings of its example for scans; the
// noise bound is the voxel size.

#include "families.h"
#include "silence.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <teaser/registration.h>

namespace pcl_flashreg::evaluate {
namespace {

using Points = Eigen::Matrix<double, 3, Eigen::Dynamic>;

Answer
runTeaser(double leaf, const Correspondences& given)
{
  teaser::RobustRegistrationSolver::Params params;
  params.noise_bound = leaf;
  params.cbar2 = 1;
  params.estimate_scaling = false;
  params.rotation_max_iterations = 100;
  params.rotation_gnc_factor = 1.4;
  params.rotation_estimation_algorithm =
      teaser::RobustRegistrationSolver::ROTATION_ESTIMATION_ALGORITHM::GNC_TLS;
  params.rotation_cost_threshold = 0.005;
  const auto n = static_cast<Eigen::Index>(given.size());
  const Points source = Eigen::Map<const Points>(given.source.data(), 3, n);
  const Points target = Eigen::Map<const Points>(given.target.data(), 3, n);

  const Silence silence; // its search for cliques talks
  const detail::Stopwatch estimation;
  teaser::RobustRegistrationSolver solver(params);
  const teaser::RegistrationSolution solution = solver.solve(source, target);
  Answer answer;
  answer.estimation_ms = estimation.milliseconds();
  answer.found = solution.valid;
  answer.trusted = answer.found;
  answer.T_target_source = {solution.rotation, solution.translation};
  answer.inliers = solver.getInlierMaxClique().size();
  answer.confidence = static_cast<double>(answer.inliers);
  return answer;
}

} // namespace

std::vector<MethodEntry>
teaserMethods()
{
  return {{"teaser", "TEASER++; OpenMP's threads", false, [](const MethodSettings& s) {
             const double leaf = s.leaf;
             return [leaf](const Problem& problem) {
               return runTeaser(leaf, problem.correspondences);
             };
           }}};
}

} // namespace pcl_flashreg::evaluate
