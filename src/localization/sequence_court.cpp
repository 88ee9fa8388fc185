// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "localization/sequence_court.h"

#include "judgement/cloud_check.h"
#include "judgement/cpu/principal_motions.h"
#include "judgement/free_motion.h"
#include "judgement/screening.h"
#include "math/isometry.h"

#include <algorithm>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Scans that are asked while hypotheses are screened, at most. */
constexpr std::size_t ASKED = 32;

/** \brief Hypotheses that pass the screening: more than of one scan, since where one is in
 * doubt many places look alike. */
constexpr std::size_t PASSING = 24;

/** \brief By how much the clouds lead, of all scans together. A scan that tells the places apart
 * must not be drowned by many that don't: what exceeds chance in each adds up, too. */
double
leadOfClouds(const PlacedSequence& best, const PlacedSequence& other)
{
  double beyond_chance = 0;
  for (std::size_t i = 0; i < best.of_scans.size(); ++i) {
    const double lead = evidenceOf(best.of_scans[i]) - evidenceOf(other.of_scans[i]);
    beyond_chance += lead - std::clamp(lead, -ALIKE_IN_MAP, ALIKE_IN_MAP);
  }
  const double together = leadByClouds(best, other);
  return beyond_chance > 0 ? std::max(together, ALIKE_IN_MAP + beyond_chance)
                           : together + beyond_chance;
}

/** \brief All of the sequence, moved in the map. */
MapPoses
moved(const MapPoses& places, const Pose& motion)
{
  const Eigen::Isometry3d T = toIsometry(motion);
  MapPoses result;
  for (const Eigen::Isometry3d& place : places)
    result.push_back(T * place);
  return result;
}

} // namespace

SequenceCourt::SequenceCourt(const SequenceClouds& clouds,
                             std::vector<std::vector<ListedPlace>> lists,
                             ThreadPool& pool)
    : clouds_(clouds), lists_(std::move(lists)), pool_(pool), look_(clouds, AT_EACH)
{
}

/** \brief The best that differ, by the clouds alone and on a few points of some scans. */
std::vector<SequenceCourt::Hypothesis>
SequenceCourt::screened() const
{
  struct Ranked {
    Hypothesis hypothesis;
    MapPoses places;
    double share;
  };
  std::vector<Ranked> all;
  for (std::size_t scan = 0; scan < lists_.size(); ++scan)
    for (const ListedPlace& listed : lists_[scan])
      all.push_back({{scan, listed.place}, clouds_.around(scan, listed.place), 0});
  const SequenceLook look(clouds_, WHILE_SCREENING, ASKED);
  pool_.forEach(all.size(), [&](std::size_t i, std::size_t) {
    all[i].share = shareOf(look(all[i].places));
  });
  std::stable_sort(all.begin(), all.end(), [](const Ranked& a, const Ranked& b) {
    return a.share > b.share;
  });
  std::vector<const Ranked*> passing;
  for (const Ranked& ranked : all)
    if (passing.size() < PASSING &&
        std::none_of(passing.begin(), passing.end(), [&](const Ranked* other) {
          return clouds_.same(ranked.places, other->places);
        }))
      passing.push_back(&ranked);
  std::vector<Hypothesis> result;
  for (const Ranked* ranked : passing)
    result.push_back(ranked->hypothesis);
  return result;
}

void
SequenceCourt::study(const std::vector<Hypothesis>& hypotheses)
{
  const std::size_t first = placements_.size();
  placements_.resize(first + hypotheses.size());
  pool_.forEach(hypotheses.size(), [&](std::size_t i, std::size_t) {
    PlacedSequence& placement = placements_[first + i];
    placement.found_by = hypotheses[i].scan;
    placement.places = clouds_.settled(hypotheses[i].scan, hypotheses[i].place);
    placement.of_scans = look_.ofEach(placement.places);
    placement.agreement = look_.ofAll(placement.of_scans);
    addSupport(placement);
  });
}

void
SequenceCourt::addSupport(PlacedSequence& placement) const
{
  for (std::size_t i = 0; i < lists_.size(); ++i) {
    double most = 0;
    for (const ListedPlace& listed : lists_[i])
      if (samePlace(listed.place, placement.places[i], clouds_.spacing()))
        most = std::max(most, listed.inliers);
    placement.support += most;
    placement.supporters += most > 0 ? 1 : 0;
  }
}

/** \brief Off this placement, unless that is where the last walk went: all scans are moved
 * together. */
void
SequenceCourt::walk(std::size_t placement)
{
  if (walked_from_ == placement)
    return;
  walked_from_ = placement;
  const MapPoses& places = placements_[placement].places;
  const SequenceLook look(clouds_, ON_THE_WAY);
  walks_ = walkOff(
      principalMotions(clouds_.contacts(places)),
      toPose(Eigen::Isometry3d::Identity()),
      static_cast<float>(clouds_.spacing()),
      [&](const Pose& motion) { return look(moved(places, motion)); },
      pool_);
}

std::vector<SequenceCourt::Hypothesis>
SequenceCourt::peaks(std::size_t placement) const
{
  const PlacedSequence& from = placements_[placement];
  std::vector<Hypothesis> result;
  for (const Pose& motion : peaksOf(walks_, Upright(), TAKEN_UP))
    result.push_back({from.found_by, toIsometry(motion) * from.places[from.found_by]});
  return result;
}

SequenceFindings
SequenceCourt::findings() const
{
  SequenceFindings findings;
  findings.placements = distinctOf(placements_, [&](const auto& a, const auto& b) {
    return clouds_.same(a.places, b.places);
  });
  const std::vector<PlacedSequence>& placements = findings.placements;
  const PlacedSequence& first = placements.front();
  Evidence& evidence = findings.evidence;
  evidence.inliers = first.support;
  evidence.has_clouds = true;
  evidence.has_viewpoints = clouds_.seeing();
  evidence.one_viewpoint = evidence.has_viewpoints;
  evidence.in_map = true;
  evidence.agreement = SequenceLook(clouds_, AT_THE_BEST)(first.places);
  evidence.lead = leadOf(first, nullptr);
  for (std::size_t i = 1; i < placements.size(); ++i) {
    const PlacedSequence& other = placements[i];
    const double by_clouds = leadOfClouds(first, other);
    const double lead =
        by_clouds + weightOf(first) - weightOf(other) - leadByClouds(first, other);
    evidence.lead = std::min(evidence.lead, lead);
    evidence.rivals += loudnessInMap(lead, by_clouds);
  }
  addWalks(walks_, evidence);
  findings.free_motions = freeMotionsOf(walks_);
  return findings;
}

SequenceFindings
SequenceCourt::judge()
{
  study(screened());
  if (placements_.empty())
    return {};
  std::size_t best = heaviestOf(placements_);
  walk(best);
  for (int walks = 1; walks < WALKS; ++walks) {
    study(peaks(best));
    const std::size_t now = heaviestOf(placements_);
    if (now == best)
      break;
    best = now;
    walk(best);
  }
  return findings();
}

} // namespace pcl_flashreg
