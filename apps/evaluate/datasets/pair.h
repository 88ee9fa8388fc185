// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <string>

namespace pcl_flashreg::evaluate {

/** \brief Two clouds with a known pose. Paths are relative to DataSet::root. */
struct Pair {
  std::string dataset;
  /** \brief Part of the data set that results are listed apart for. */
  std::string scene;
  std::string source;
  std::string target;
  /** \brief File of correspondences; empty if they are to be made from the clouds.
   * "a_{src,dst}.txt" stands for two files of points. */
  std::string correspondences;
  /** \brief The translation is not a number where no pose is right: the clouds do not
   * overlap. */
  RigidTransform T_target_source;
  /** \brief The pose is off by more than what counts as right: see refineTruth(). */
  bool refine_truth = false;
};

} // namespace pcl_flashreg::evaluate
