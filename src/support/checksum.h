// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/byte_order.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace pcl_flashreg {

/** \brief Tells damaged bytes from whole ones, nothing that an adversary made: whatever
 * changes in one word changes the result.
 * \param[in] size a multiple of 8
 */
inline std::uint64_t
checksumOf(const char* bytes, std::size_t size)
{
  // FNV's numbers, eight bytes a step; the shift lets high bits reach low ones.
  std::uint64_t sum = 0xcbf29ce484222325u;
  for (std::size_t i = 0; i < size; i += 8) {
    std::uint64_t word;
    std::memcpy(&word, bytes + i, 8);
    swapToLittleEndian(reinterpret_cast<char*>(&word), 8, 8);
    sum = (sum ^ word) * 0x100000001b3u;
    sum ^= sum >> 32;
  }
  return sum;
}

} // namespace pcl_flashreg
