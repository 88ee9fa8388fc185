// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/sequence_localization.h>

#include "estimation/preparation.h"
#include "judgement/confidence.h"
#include "localization/sequence_court.h"
#include "multiview/mean_motion.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace {

/** \brief Hypotheses of a scan: as many as are brought before its clouds. */
constexpr int HYPOTHESES = 32;

void
check(const std::vector<SequenceScan>& scans)
{
  for (std::size_t i = 0; i < scans.size(); ++i) {
    const RigidTransform& T = scans[i].T_sequence_scan;
    if (!T.rotation.allFinite() || !T.translation.allFinite())
      throw std::invalid_argument("scans: the pose of scan " + std::to_string(i) +
                                  " is not finite");
  }
}

std::vector<std::vector<ListedPlace>>
listsOf(const std::vector<SequenceScan>& scans, const SequenceClouds& clouds)
{
  std::vector<std::vector<ListedPlace>> lists(scans.size());
  for (std::size_t i = 0; i < scans.size(); ++i)
    for (const Hypothesis& hypothesis : scans[i].alone.hypotheses)
      lists[i].push_back(
          {betweenMiddles(hypothesis.T_target_source, clouds.map(), clouds.about(i)),
           static_cast<double>(hypothesis.inlier_count)});
  return lists;
}

RigidTransform
poseOfAll(const SequenceClouds& clouds, const MapPoses& places)
{
  MeanMotion mean;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Eigen::Isometry3d& T = clouds.T_sequence_scan()[i];
    mean.add(1,
             places[i].linear() * T.linear().transpose(),
             T.translation(),
             places[i].translation());
  }
  return betweenFrames(mean.get(), clouds.map(), MapScan());
}

SequencePlacement
placementOf(const PlacedSequence& placed, const SequenceClouds& clouds)
{
  SequencePlacement result;
  result.T_map_sequence = poseOfAll(clouds, placed.places);
  result.agreement = placed.agreement;
  result.supporters = placed.supporters;
  result.inliers = placed.support;
  result.agreement_of_scan = placed.of_scans;
  for (std::size_t i = 0; i < clouds.size(); ++i)
    result.T_map_scan.push_back(
        betweenFrames(placed.places[i], clouds.map(), clouds.about(i)));
  return result;
}

} // namespace

PairOptions
forSequence(PairOptions options)
{
  options.parameters.max_hypotheses =
      std::max(options.parameters.max_hypotheses, HYPOTHESES);
  return options;
}

SequenceResult
localizeSequence(const std::vector<SequenceScan>& scans,
                 const ScanIndex& map,
                 const PairOptions& options,
                 unsigned num_threads)
{
  options.parameters.validate();
  check(scans);
  SequenceResult result;
  if (scans.empty() || map.scan().empty())
    return result;
  ThreadPool pool(num_threads);
  const SequenceClouds clouds(scans, map.data(), uprightOf(options.parameters), pool);
  const SequenceFindings findings =
      SequenceCourt(clouds, listsOf(scans, clouds), pool).judge();
  if (findings.placements.empty())
    return result;
  for (const PlacedSequence& placed : findings.placements)
    result.placements.push_back(placementOf(placed, clouds));
  result.placements.front().agreement = findings.evidence.agreement;
  result.free_motions = findings.free_motions;
  for (FreeMotion& motion : result.free_motions)
    motion.point += clouds.map().middle;
  result.evidence = findings.evidence;
  result.confidence = confidenceOf(result.evidence);
  result.converged = result.confidence >= options.parameters.min_confidence;
  return result;
}

} // namespace pcl_flashreg
