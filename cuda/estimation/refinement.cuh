// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief Stage 7: fills Call::listed and Call::listed_inliers.
 * \param[in] cooperative one launch, whose blocks wait for each other, instead of as many
 * as there can be rounds of refinement
 */
void
refinement(const Call& call,
           bool cooperative,
           unsigned multiprocessors,
           cudaStream_t stream);

} // namespace cuda
} // namespace pcl_flashreg
