// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cuda_runtime.h>

namespace pcl_flashreg {
namespace cuda {

constexpr unsigned SLOT_BITS = 25;
constexpr unsigned LARGEST_SLOT = (1u << SLOT_BITS) - 1;

/** \brief A number whose descending order is score, then pivot and clique order. */
__device__ inline unsigned long long
rankOf(long long score, unsigned slot)
{
  return (static_cast<unsigned long long>(score) << SLOT_BITS) | (LARGEST_SLOT - slot);
}
__device__ inline unsigned
slotOf(unsigned long long rank)
{
  return LARGEST_SLOT - (static_cast<unsigned>(rank) & LARGEST_SLOT);
}

} // namespace cuda
} // namespace pcl_flashreg
