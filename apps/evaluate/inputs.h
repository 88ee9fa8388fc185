// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>

#include <Eigen/Core>

#include <map>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Putative correspondences, N x 3 each, and their ranks (empty if there are none). */
struct Input {
  std::vector<double> source, target;
  std::vector<float> ranks;

  std::size_t
  size() const
  {
    return source.size() / 3;
  }
};

/** \brief Features of the clouds seen so far: a cloud belongs to many pairs. */
class FeatureStore {
public:
  FeatureStore(std::string root, double leaf, unsigned threads)
      : root_(std::move(root)), leaf_(leaf), threads_(threads)
  {
  }

  struct Entry {
    FpfhCloud keypoints;
    Eigen::Vector3d shift;
  };

  /** \throws io::InputError, std::invalid_argument (see computeFpfh()) */
  const Entry&
  get(const std::string& path);

private:
  std::string root_;
  double leaf_;
  unsigned threads_;
  std::map<std::string, Entry> entries_;
};

/** \brief Matches of every source keypoint with its nearest target keypoints. */
Input
matchClouds(const FeatureStore::Entry& source,
            const FeatureStore::Entry& target,
            std::size_t neighbors,
            unsigned threads);

/** \brief Reads six columns, or two files of three where the path holds "{src,dst}".
 * \throws io::InputError
 */
Input
readCorrespondences(const std::string& path);

} // namespace pcl_flashreg::evaluate
