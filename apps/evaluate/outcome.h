// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "inputs.h"
#include "pairs.h"

#include <iosfwd>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief What a method says of a pair. */
struct Answer {
  bool found = false;
  RigidTransform T_target_source;
  /** \brief The method's own verdict. */
  bool trusted = false;
  std::size_t inliers = 0;
  double distinctness = 0;
  double estimation_ms = 0;
};

/** \brief Below which errors a pose counts as right. */
struct Criterion {
  double max_rotation = 15;
  double max_translation = 0.3;
};

/** \brief How one pair came out. */
struct Outcome {
  Answer answer;
  std::size_t correspondences = 0;
  /** \brief Share of the correspondences that agree with the true pose. */
  double inlier_ratio = 0;
  double matching_ms = 0;
  /** \brief Degrees. */
  double rotation_error = 180;
  double translation_error = 0;
  bool success = false;
};

/** \brief Compares an answer with the true pose. */
Outcome
judge(const Answer& answer,
      const Pair& pair,
      const Input& input,
      double inlier_distance,
      const Criterion& criterion);

/** \brief One line: recall, errors of the successes, the verdict, the time. */
void
printSummary(const std::string& dataset, const std::vector<Outcome>& outcomes);

void
writeCsvHeader(std::ostream& csv);

void
writeCsvRow(std::ostream& csv, const Pair& pair, const Outcome& outcome);

} // namespace pcl_flashreg::evaluate
