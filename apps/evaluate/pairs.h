// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Two clouds with a known pose. Paths are as in the list. */
struct Pair {
  std::string dataset;
  std::string source;
  std::string target;
  /** \brief File of correspondences; empty if there is none. "a_{src,dst}.txt" stands for
   * two files of points. */
  std::string correspondences;
  RigidTransform T_target_source;
};

/** \brief Reads a list of pairs: a tab-separated file with the columns dataset, split,
 * source, target, correspondences, note, and the 16 numbers of T_target_source, row-major;
 * lines that begin with # are left out.
 * \throws io::InputError with the number of the line
 */
std::vector<Pair>
readPairs(const std::string& path);

} // namespace pcl_flashreg::evaluate
