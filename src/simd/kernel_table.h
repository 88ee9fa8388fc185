// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "simd/simd_kernels.h"
#include "simd/surface_kernels.h"

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief The hot loops over V; counting common neighbours may be an own one. */
template <typename V>
constexpr Kernels
simdKernels(const char* name, decltype(Kernels::commonNeighbours) commonNeighbours)
{
  return {name,
          &edgeTestSimd<V, false>,
          &edgeTestSimd<V, true>,
          &transposeBits,
          commonNeighbours,
          &countBitsIn,
          &intersectRows,
          &residualTestSimd<V>,
          &featureCandidatesSimd<V>,
          &collectNeighborsSimd<V>,
          &momentSumsSimd<V>,
          &pairHistogramSimd<V>,
          &weightedRowSumSimd<V>};
}

} // namespace
} // namespace cpu
} // namespace pcl_flashreg
