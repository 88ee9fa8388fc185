// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "localization/scan_index_data.h"
#include "registration/pair_workers.h"

#include <vector>

namespace pcl_flashreg {

/** \brief Matches of keypoints as PairOptions wants them. */
std::vector<FeatureMatch>
matchScans(const Scan& source,
           const Scan& target,
           const PairOptions& options,
           ThreadPool& pool);

/** \brief Each keypoint of a scan with its nearest of a map.
 * \param[in] index of the map; null if none was made, empty if nothing can be found */
std::vector<FeatureMatch>
matchInMap(const Scan& scan,
           const Scan& map,
           const std::optional<FeatureIndex>* index,
           std::size_t neighbors,
           ThreadPool& pool);

/** \brief What was matched first. */
struct MatchedScans {
  const Scan& source;
  const Scan& target;
  /** \brief Of the target, where it is a map that has one. */
  const ScanIndex::Data* index;
};

/** \brief What to match where the first matches, of each source keypoint, leave doubt: each
 * target keypoint with its nearest of the source, and both ways again at a coarser
 * resolution. A keypoint that lies where the other cloud is not has a wrong match in any
 * case, so that of the smaller one of both overlapping shares fewer are wrong; and what is
 * smooth at one resolution may have a shape at another. In a map, all of it at the coarser
 * resolution, and the places that most matches lie in, at either. */
class OtherMatches {
public:
  /** \brief Keeps all arguments. */
  OtherMatches(const MatchedScans& scans,
               const PairOptions& options,
               PairWorkers& workers)
      : scans_(scans), options_(options), workers_(workers)
  {
  }

  /** \brief The next of them, from 0 on, in this order; nothing at the end. */
  std::optional<OtherCorrespondences>
  get(std::size_t number);

private:
  /** \brief Whether descriptors can be made at another resolution. */
  bool
  areOurs() const;
  Correspondences
  forth(const Scan& source, const Scan& target) const;
  Correspondences
  back(const Scan& source, const Scan& target) const;
  void
  makeCoarse();
  std::optional<OtherCorrespondences>
  getInMap(std::size_t number);
  void
  addCoarseParts();
  void
  addFineParts();
  void
  addPlaces(const Scan& scan,
            const Scan& map,
            const std::vector<FeatureMatch>& matches);

  const MatchedScans scans_;
  const PairOptions& options_;
  PairWorkers& workers_;
  Scan coarse_source_, coarse_target_;
  /** \brief Of a map. */
  std::vector<OtherCorrespondences> parts_;
  bool has_fine_ = false;
};

} // namespace pcl_flashreg
