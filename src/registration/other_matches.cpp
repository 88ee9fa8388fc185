// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/other_matches.h"

#include "localization/places.h"
#include "matching/search.h"

#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief Parts of a map that are looked at, at either resolution. */
constexpr std::size_t MOST_PLACES = 16;

} // namespace

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
           const std::optional<FeatureIndex>* index,
           std::size_t neighbors,
           ThreadPool& pool)
{
  if (index)
    return *index ? (*index)->search(scan.features(), neighbors, pool)
                  : std::vector<FeatureMatch>();
  return searchFeatures(scan.features(), map.features(), neighbors, false, pool)
      .forward;
}

bool
OtherMatches::areOurs() const
{
  return !scans_.source.origins() && !scans_.target.origins();
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
OtherMatches::addPlaces(const Scan& scan,
                        const Scan& map,
                        const std::vector<FeatureMatch>& matches)
{
  for (const auto& place : matchesByPlace(scan, map, matches, MOST_PLACES))
    parts_.push_back({toCorrespondences(scan, map, place), false, true});
}

void
OtherMatches::addCoarseParts()
{
  // Who brings descriptors of his own has them for these keypoints alone.
  if (!areOurs())
    return;
  makeCoarse();
  const std::vector<FeatureMatch> matches =
      matchInMap(coarse_source_,
                 coarse_target_,
                 scans_.index ? &scans_.index->coarse_features : nullptr,
                 NEIGHBORS_IN_MAP,
                 workers_.search.pool());
  parts_.push_back(
      {toCorrespondences(coarse_source_, coarse_target_, firstOfEach(matches)),
       false,
       false});
  addPlaces(coarse_source_, coarse_target_, matches);
}

void
OtherMatches::addFineParts()
{
  addPlaces(scans_.source,
            scans_.target,
            matchInMap(scans_.source,
                       scans_.target,
                       scans_.index ? &scans_.index->features : nullptr,
                       NEIGHBORS_IN_MAP,
                       workers_.search.pool()));
}

/** \brief Coarse ones first: they cost a fifth, and more of them are right. */
std::optional<OtherCorrespondences>
OtherMatches::getInMap(std::size_t number)
{
  if (number == 0)
    addCoarseParts();
  if (number == parts_.size() && !std::exchange(has_fine_, true))
    addFineParts();
  if (number == parts_.size())
    return std::nullopt;
  return std::move(parts_[number]);
}

std::optional<OtherCorrespondences>
OtherMatches::get(std::size_t number)
{
  const Scan &source = scans_.source, &target = scans_.target;
  if (isMapFor(target, source))
    return getInMap(number);
  if (number == 0)
    return OtherCorrespondences{back(source, target), true};
  if (!areOurs() || number > 2)
    return std::nullopt;
  if (number == 1) {
    makeCoarse();
    return OtherCorrespondences{forth(coarse_source_, coarse_target_), false};
  }
  return OtherCorrespondences{back(coarse_source_, coarse_target_), false};
}

} // namespace pcl_flashreg
