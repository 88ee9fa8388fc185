// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "results_file.h"

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Mean and median; 0 of nothing. */
struct Average {
  double mean = 0, median = 0;
};

/** \brief Median and 95th percentile; 0 of nothing. */
struct Spread {
  double median = 0, p95 = 0;
};

/** \brief A stage and how long it took, in milliseconds. */
struct StageSpread {
  std::string name;
  Spread spread;
};

/** \brief How a method did on a group of pairs. */
struct MethodSummary {
  std::string method;
  std::size_t successes = 0;
  /** \brief Share of the pairs. */
  double recall = 0;
  /** \brief Over the successes: degrees, and the unit of the clouds. */
  Average rotation_error, translation_error;
  std::size_t trusted = 0;
  /** \brief Share of the trusted poses that are right; NaN if none is trusted. */
  double precision = 0;
  /** \brief Share of the right poses that are trusted; NaN if none is right. */
  double verdict_recall = 0;
  Spread features_ms, matching_ms, estimation_ms;
  std::vector<StageSpread> stages_ms;
  /** \brief Against the first method: recall minus its recall, and median time of the
   * estimation over its median time. */
  double recall_difference = 0, time_ratio = 1;
};

/** \brief Pairs that are summed up together. */
struct GroupSummary {
  /** \brief Empty for all of them. */
  std::string dataset;
  /** \brief Empty for the whole data set. */
  std::string scene;
  std::size_t pairs = 0;
  Average inlier_ratio;
  Average correspondences;
  std::vector<MethodSummary> methods;
};

/** \brief Every scene (where a data set has several), every data set, and all of them (where
 * there are several), in the order of the pairs. */
std::vector<GroupSummary>
summarize(const Results& results);

} // namespace pcl_flashreg::evaluate
