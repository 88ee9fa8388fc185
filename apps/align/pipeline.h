// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "inputs.h"

#include <pcl_flashreg/pair_registration.h>

#include <vector>

namespace pcl_flashreg::align {

/** \brief What came out, and the time that it took from the first file on. */
struct Outcome {
  PairResult pair;
  /** \brief Files to coordinates in double precision. */
  double reading_ms = 0;
  /** \brief Choosing and starting the backend. */
  double setup_ms = 0;
  /** \brief From the program's start to the pose. */
  double total_ms = 0;
};

/** \brief A step's name for people, and its time. */
struct Step {
  const char* name;
  double milliseconds;
  /** \brief It is a part of the estimator's time. */
  bool of_estimator = false;
};

/** \brief All steps in their order; they add up to the total. */
std::vector<Step>
stepsOf(const Outcome& outcome);

/** \throws UsageError if --leaf does not suit the clouds
 * \throws io::InputError if the clouds give nothing to work with
 * \throws BackendError, std::bad_alloc if the machine fails
 */
Outcome
alignInputs(const Options& options, const Inputs& inputs, const Messages& messages);

} // namespace pcl_flashreg::align
