// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/other_matches.h"

#include "localization/places.h"
#include "matching/search.h"

#include <utility>
#include <cstdlib>

namespace pcl_flashreg {

std::vector<FeatureMatch>
matchScans(const Scan& source,
           const Scan& target,
           const PairOptions& options,
           ThreadPool& pool)
{
  MutualMatches matches = searchFeatures(
      source.features(), target.features(), options.neighbors, options.mutual, pool);
  return options.mutual ? matches.mutual() : std::move(matches.forward);
}

std::vector<FeatureMatch>
matchInMap(const Scan& scan,
           const Scan& map,
           const ScanIndex::Data* index,
           std::size_t neighbors,
           ThreadPool& pool)
{
  if (index && index->features)
    return index->features->search(scan.features(), neighbors, pool);
  return searchFeatures(scan.features(), map.features(), neighbors, false, pool).forward;
}

Correspondences
OtherMatches::forth(const Scan& source, const Scan& target) const
{
  return toCorrespondences(
      source, target, matchScans(source, target, options_, workers_.search.pool()));
}

Correspondences
OtherMatches::back(const Scan& source, const Scan& target) const
{
  Correspondences correspondences = forth(target, source);
  std::swap(correspondences.source, correspondences.target);
  return correspondences;
}

void
OtherMatches::makeCoarse()
{
  coarse_source_ = workers_.maker.coarser(scans_.source, COARSER);
  coarse_target_ = scans_.index ? scans_.index->coarse
                                : workers_.maker.coarser(scans_.target, COARSER);
}

void
OtherMatches::findPlaces()
{
  const std::size_t most=getenv("X_PL") ? atoi(getenv("X_PL")) : 8;
  const int F=getenv("X_F")?atoi(getenv("X_F")):3;
  const auto add = [&](const Scan& scan,
                       const Scan& map,
                       const std::vector<FeatureMatch>& matches) {
    for (const std::vector<FeatureMatch>& place : matchesByPlace(scan, map, matches, most))
      places_.push_back(toCorrespondences(scan, map, place));
  };
  ThreadPool& pool = workers_.search.pool();
  if(F&1) add(scans_.source,
      scans_.target,
      scans_.candidates.empty() ? matchInMap(scans_.source,
                                             scans_.target,
                                             scans_.index,
                                             NEIGHBORS_IN_MAP,
                                             pool)
                                : scans_.candidates);
  if (scans_.source.origins() || scans_.target.origins() || !(F&2))
    return;
  makeCoarse();
  const FeatureIndex* const index =
      scans_.index && scans_.index->coarse_features ? &*scans_.index->coarse_features
                                                    : nullptr;
  add(coarse_source_,
      coarse_target_,
      index ? index->search(coarse_source_.features(), NEIGHBORS_IN_MAP, pool)
            : searchFeatures(coarse_source_.features(),
                             coarse_target_.features(),
                             NEIGHBORS_IN_MAP,
                             false,
                             pool)
                  .forward);
}

std::optional<OtherCorrespondences>
OtherMatches::get(std::size_t number)
{
  const auto& [source, target, index, candidates] = scans_;
  if (isMapFor(target, source)&&!getenv("X_NOPL")) {
    if (number == 0)
      findPlaces();
    if (number == places_.size())
      return std::nullopt;
    return OtherCorrespondences{std::move(places_[number]), false};
  }
  if (number == 0)
    return OtherCorrespondences{back(source, target), true};
  // Who brings descriptors of his own has them for these keypoints alone.
  const bool are_ours = !source.origins() && !target.origins();
  if (!are_ours || number > 2)
    return std::nullopt;
  if (number == 1) {
    makeCoarse();
    return OtherCorrespondences{forth(coarse_source_, coarse_target_), false};
  }
  return OtherCorrespondences{back(coarse_source_, coarse_target_), false};
}

} // namespace pcl_flashreg
