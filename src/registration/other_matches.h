// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "registration/pair_workers.h"

#include <vector>

namespace pcl_flashreg {

/** \brief Matches of keypoints as PairOptions wants them. */
std::vector<FeatureMatch>
matchScans(const Scan& source,
           const Scan& target,
           const PairOptions& options,
           ThreadPool& pool);

/** \brief What to match where the first matches, of each source keypoint, leave doubt: each
 * target keypoint with its nearest of the source, and both ways again at a coarser
 * resolution. A keypoint that lies where the other cloud is not has a wrong match in any
 * case, so that of the smaller one of both overlapping shares fewer are wrong; and what is
 * smooth at one resolution may have a shape at another. */
class OtherMatches {
public:
  /** \brief Keeps all arguments. */
  OtherMatches(const Scan& source,
               const Scan& target,
               const PairOptions& options,
               PairWorkers& workers)
      : source_(source), target_(target), options_(options), workers_(workers)
  {
  }

  /** \brief The next of them, from 0 on, in this order; nothing at the end. */
  std::optional<OtherCorrespondences>
  get(std::size_t number);

private:
  Correspondences
  forth(const Scan& source, const Scan& target) const;
  Correspondences
  back(const Scan& source, const Scan& target) const;

  const Scan& source_;
  const Scan& target_;
  const PairOptions& options_;
  PairWorkers& workers_;
  Scan coarse_source_, coarse_target_;
};

} // namespace pcl_flashreg
