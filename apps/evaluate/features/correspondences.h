// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "described_cloud.h"

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Putative correspondences, N x 3 each, in the frames of the clouds' files. */
struct Correspondences {
  std::vector<double> source, target;
  /** \brief Distance in feature space, smaller is better; empty if there is none. */
  std::vector<float> ranks;

  std::size_t
  size() const
  {
    return source.size() / 3;
  }
};

/** \brief Matches of every source keypoint with its nearest target keypoints. */
Correspondences
matchClouds(const DescribedCloud& source,
            const DescribedCloud& target,
            std::size_t neighbors,
            unsigned threads);

/** \brief Reads six columns, or two files of three where the path holds "{src,dst}".
 * \throws io::InputError with the file, and the line where there is one
 */
Correspondences
readCorrespondences(const std::string& path);

} // namespace pcl_flashreg::evaluate
