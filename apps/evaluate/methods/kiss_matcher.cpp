// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// KISS-Matcher from given correspondences: ROBIN's maximum core, then graduated
// non-convexity. Its noise bounds follow from the voxel size as in its own configuration.
// It never frees the graph of a pair: long lists are better done in shards.

#include "families.h"
#include "silence.h"

#include <pcl_flashreg/impl/number_text.hpp>
#include <pcl_flashreg/impl/stopwatch.hpp>

#include <kiss_matcher/KISSMatcher.hpp>

#include <stdexcept>

namespace pcl_flashreg::evaluate {
namespace {

using kiss_matcher::KISSMatcherConfig;

/** \brief Fewer of them, and the authors' example says that it might have failed. */
constexpr std::size_t LEAST_FINAL_INLIERS = 5;

/** \brief The authors' bounds: 1 and 0.75 voxels, each of 1 at most.
 * \throws std::invalid_argument if the voxels are too small for it
 */
KISSMatcherConfig
configFor(double leaf)
{
  const Silence silence; // it says so where it takes 1
  try {
    return KISSMatcherConfig(static_cast<float>(leaf));
  }
  catch (const std::runtime_error&) {
    throw std::invalid_argument("leaf = " + detail::toText(leaf) +
                                ": must be larger than 0.005");
  }
}

std::vector<Eigen::Vector3f>
toPoints(const std::vector<double>& xyz)
{
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3)
    points.push_back(Eigen::Map<const Eigen::Vector3d>(&xyz[i]).cast<float>());
  return points;
}

Answer
runKissMatcher(const KISSMatcherConfig& config, const Correspondences& given)
{
  const std::vector<Eigen::Vector3f> source = toPoints(given.source);
  const std::vector<Eigen::Vector3f> target = toPoints(given.target);

  const detail::Stopwatch estimation;
  kiss_matcher::KISSMatcher matcher(config);
  const kiss_matcher::RegistrationSolution solution =
      matcher.pruneAndSolve(source, target);
  Answer answer;
  answer.estimation_ms = estimation.milliseconds();
  answer.found = solution.valid;
  answer.T_target_source = {solution.rotation, solution.translation};
  answer.inliers = matcher.getNumFinalInliers();
  answer.trusted = answer.found && answer.inliers >= LEAST_FINAL_INLIERS;
  answer.confidence = static_cast<double>(answer.inliers);
  return answer;
}

} // namespace

std::vector<MethodEntry>
kissMatcherMethods()
{
  return {{"kiss_matcher",
           "KISS-Matcher's pruning and solver; OpenMP's threads",
           false,
           [](const MethodSettings& settings) {
             const KISSMatcherConfig config = configFor(settings.leaf);
             return [config](const Problem& problem) {
               return runKissMatcher(config, problem.correspondences);
             };
           }}};
}

} // namespace pcl_flashreg::evaluate
