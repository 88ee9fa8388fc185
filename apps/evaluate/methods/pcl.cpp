// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// PCL's own: RANSAC on correspondences, and SampleConsensusPrerejective on clouds.

#include "families.h"

#include <pcl_flashreg/fpfh_features.h>

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <pcl/registration/correspondence_rejection_sample_consensus.h>
#include <pcl/registration/sample_consensus_prerejective.h>

#include <cstdlib>

namespace pcl_flashreg::evaluate {
namespace {

using Points = pcl::PointCloud<pcl::PointXYZ>;

Points::Ptr
toPoints(const std::vector<double>& xyz)
{
  Points::Ptr points(new Points);
  for (std::size_t i = 0; i + 3 <= xyz.size(); i += 3)
    points->emplace_back(static_cast<float>(xyz[i]),
                         static_cast<float>(xyz[i + 1]),
                         static_cast<float>(xyz[i + 2]));
  return points;
}

Answer
runRansac(int iterations, double inlier_distance, const Correspondences& given)
{
  pcl::registration::CorrespondenceRejectorSampleConsensus<pcl::PointXYZ> rejector;
  rejector.setInputSource(toPoints(given.source));
  rejector.setInputTarget(toPoints(given.target));
  rejector.setInlierThreshold(inlier_distance);
  rejector.setMaximumIterations(iterations);
  rejector.setRefineModel(true);
  pcl::Correspondences all, remaining;
  for (int i = 0; i < static_cast<int>(given.size()); ++i)
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
  answer.confidence = static_cast<double>(answer.inliers);
  return answer;
}

/** \brief Settings of PCL's tutorial "Robust pose estimation of rigid objects". */
Answer
runPrerejective(double leaf, const Scan& source, const Scan& target)
{
  const FpfhCloud from = detail::toFpfhCloud(source), to = detail::toFpfhCloud(target);
  pcl::SampleConsensusPrerejective<pcl::PointXYZ, pcl::PointXYZ, pcl::FPFHSignature33>
      align;
  align.setInputSource(from.points);
  align.setSourceFeatures(from.features);
  align.setInputTarget(to.points);
  align.setTargetFeatures(to.features);
  align.setMaximumIterations(50000);
  align.setNumberOfSamples(3);
  align.setCorrespondenceRandomness(5);
  align.setSimilarityThreshold(0.9f);
  align.setMaxCorrespondenceDistance(2.5 * leaf);
  align.setInlierFraction(0.25f);
  // It draws from rand(): without a seed the answer would depend on the pairs before.
  std::srand(1);

  const detail::Stopwatch estimation;
  Points aligned;
  align.align(aligned);
  Answer answer;
  answer.estimation_ms = estimation.milliseconds();
  const Eigen::Matrix4d T = align.getFinalTransformation().cast<double>();
  const Eigen::Matrix3d R = T.topLeftCorner<3, 3>();
  answer.found = align.hasConverged();
  answer.trusted = answer.found;
  answer.T_target_source = {
      R, T.topRightCorner<3, 1>() + target.shift() - R * source.shift()};
  answer.inliers = align.getInliers().size();
  answer.confidence = static_cast<double>(answer.inliers);
  return answer;
}

MethodEntry
ransacEntry(int thousands)
{
  const std::string count = std::to_string(thousands);
  return {"pcl_ransac_" + count + "k",
          "CorrespondenceRejectorSampleConsensus, " + count +
              ",000 iterations at most, refined; one thread",
          false,
          [thousands](const MethodSettings& settings) {
            const double inlier_distance = settings.parameters.inlier_distance;
            return [=](const Problem& problem) {
              return runRansac(
                  1000 * thousands, inlier_distance, problem.correspondences);
            };
          }};
}

} // namespace

std::vector<MethodEntry>
pclMethods()
{
  return {ransacEntry(10),
          ransacEntry(50),
          {"pcl_prerejective",
           "SampleConsensusPrerejective on the keypoints and their features, the "
           "tutorial's settings; one thread",
           true,
           [](const MethodSettings& settings) {
             const double leaf = settings.leaf;
             return [leaf](const Problem& problem) {
               return runPrerejective(leaf, problem.source, problem.target);
             };
           }}};
}

} // namespace pcl_flashreg::evaluate
