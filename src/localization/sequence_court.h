// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "judgement/standing.h"
#include "judgement/walk.h"
#include "localization/sequence_clouds.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_flashreg {

/** \brief Where a scan may be, by itself. */
struct ListedPlace {
  Eigen::Isometry3d place;
  /** \brief Correspondences that agree. */
  double inliers;
};

/** \brief A way in which a sequence may lie in the map. */
struct PlacedSequence : Standing {
  MapPoses places;
  std::vector<CloudAgreement> of_scans;
  /** \brief The scan that it was found by. */
  std::size_t found_by = 0;
  /** \brief Scans that have it in their lists, whose correspondences are its support. */
  std::size_t supporters = 0;
};

struct SequenceFindings {
  /** \brief Distinct ones, best first. */
  std::vector<PlacedSequence> placements;
  Evidence evidence;
  /** \brief In the map's centred frame. */
  std::vector<FreeMotion> free_motions;
};

/** \brief Asks the clouds of a sequence where it is, as CloudCheck asks those of a scan: the
 * hypotheses of every scan are screened, the best are moved onto the map's surfaces and judged,
 * and the very best is walked off. */
class SequenceCourt {
public:
  /** \param[in] clouds must outlive this
   * \param[in] lists of each scan */
  SequenceCourt(const SequenceClouds& clouds,
                std::vector<std::vector<ListedPlace>> lists,
                ThreadPool& pool);

  /** \return no placement, if the lists are empty */
  SequenceFindings
  judge();

private:
  /** \brief A scan is there, and all others with it. */
  struct Hypothesis {
    std::size_t scan;
    Eigen::Isometry3d place;
  };

  std::vector<Hypothesis>
  screened() const;
  void
  study(const std::vector<Hypothesis>& hypotheses);
  void
  addSupport(PlacedSequence& placement) const;
  void
  walk(std::size_t placement);
  std::vector<Hypothesis>
  peaks(std::size_t placement) const;
  SequenceFindings
  findings() const;

  const SequenceClouds& clouds_;
  std::vector<std::vector<ListedPlace>> lists_;
  ThreadPool& pool_;
  SequenceLook look_;
  std::vector<PlacedSequence> placements_;
  std::vector<Walk> walks_;
  std::optional<std::size_t> walked_from_;
};

} // namespace pcl_flashreg
