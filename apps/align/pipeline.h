// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "inputs.h"
#include "times.h"

#include <pcl_flashreg/result.h>

#include <optional>

namespace pcl_flashreg::align {

/** \brief What came out, and what it was made from. */
struct Outcome {
  Result result;
  Parameters parameters;
  std::size_t correspondences = 0;
  /** \brief Voxel size; nothing if there is no --leaf and the correspondences are too
   * few to estimate it. */
  std::optional<double> resolution;
  Times times;
};

/** \param[in,out] clock started before anything was read
 * \throws UsageError if --leaf does not suit the clouds
 * \throws io::InputError if the clouds give nothing to work with
 * \throws BackendError, std::bad_alloc if the machine fails
 */
Outcome
alignInputs(const Options& options,
            const Inputs& inputs,
            const Progress& progress,
            StepClock& clock);

} // namespace pcl_flashreg::align
