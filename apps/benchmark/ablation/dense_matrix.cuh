// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "math/host_device.h"

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>

namespace pcl_flashreg {
namespace dense {

/** \brief Rows begin at whole multiples of this many entries, so that a warp reads whole
 * lines and tensor cores find the alignment that they want. */
constexpr std::size_t ROW_ENTRIES = 32;

/** \brief From one row of a matrix with n columns to the next. */
constexpr std::size_t
strideOf(std::size_t n)
{
  return (n + ROW_ENTRIES - 1) / ROW_ENTRIES * ROW_ENTRIES;
}

/** \brief A dense matrix in device memory, row-major. */
template <typename Value>
struct Matrix {
  Value* values;
  std::size_t stride;

  PCL_FLASHREG_HD Value*
  row(std::size_t i) const
  {
    return values + i * stride;
  }
};

/** \brief A number of IEEE half precision, of which two are needed: 0 and 1. */
struct Half {
  std::uint16_t bits;
};

PCL_FLASHREG_HD inline void
setEdge(float& entry, bool edge)
{
  entry = edge ? 1.0f : 0.0f;
}
PCL_FLASHREG_HD inline void
setEdge(Half& entry, bool edge)
{
  entry.bits = edge ? 0x3C00 : 0;
}

PCL_FLASHREG_HD inline bool
isEdge(float entry)
{
  return entry != 0;
}
PCL_FLASHREG_HD inline bool
isEdge(Half entry)
{
  return entry.bits != 0;
}

} // namespace dense
} // namespace pcl_flashreg
