// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registration/other_matches.h"

#include "matching/search.h"

#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief By how much the coarser resolution is coarser. */
constexpr double COARSER = 1.5;

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

std::optional<OtherCorrespondences>
OtherMatches::get(std::size_t number)
{
  if (number == 0)
    return OtherCorrespondences{back(source_, target_), true};
  // Who brings descriptors of his own has them for these keypoints alone.
  const bool are_ours = !source_.origins() && !target_.origins();
  if (!are_ours || number > 2)
    return std::nullopt;
  if (number == 1) {
    coarse_source_ = workers_.maker.coarser(source_, COARSER);
    coarse_target_ = workers_.maker.coarser(target_, COARSER);
    return OtherCorrespondences{forth(coarse_source_, coarse_target_), false};
  }
  return OtherCorrespondences{back(coarse_source_, coarse_target_), false};
}

} // namespace pcl_flashreg
