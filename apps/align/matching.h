// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../io/correspondence_io.h"
#include "inputs.h"

#include <pcl_flashreg/feature_matching.h>

#include <vector>

namespace pcl_flashreg::align {

/** \brief Correspondences and how good their matches are. */
struct RankedCorrespondences {
  io::Correspondences points;
  /** \brief Distance in feature space, smaller is better; empty if there is none. */
  std::vector<float> ranks;
};

/** \brief Matches descriptors: each of the source with its nearest ones of the target.
 * \param[in] mutual keep a match only if its source descriptor is among the nearest of
 * its target descriptor, too
 */
RankedCorrespondences
matchPoints(const Eigen::Matrix3Xd& source_xyz,
            const FeatureView& source_features,
            const Eigen::Matrix3Xd& target_xyz,
            const FeatureView& target_features,
            std::size_t neighbors,
            bool mutual,
            unsigned num_threads);

} // namespace pcl_flashreg::align
