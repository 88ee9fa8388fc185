// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace pcl_flashreg {

/** \brief Bits of a cell's number an axis. */
constexpr int Z_ORDER_BITS = 21;

/** \brief The bits of the three numbers of a cell in turn (Morton 1966): where cells are in
 * this order, those of a larger cubic one follow each other.
 * \param[in] cell numbers of 21 bits, >= 0 */
inline std::uint64_t
zOrderKey(const Eigen::Array3i& cell)
{
  const auto spread = [](int number) {
    auto bits = static_cast<std::uint64_t>(number);
    bits = (bits | bits << 32) & 0x001f00000000ffffu;
    bits = (bits | bits << 16) & 0x001f0000ff0000ffu;
    bits = (bits | bits << 8) & 0x100f00f00f00f00fu;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3u;
    bits = (bits | bits << 2) & 0x1249249249249249u;
    return bits;
  };
  return spread(cell[0]) | spread(cell[1]) << 1 | spread(cell[2]) << 2;
}

/** \brief The cell of a key. */
inline Eigen::Array3i
cellOfZOrderKey(std::uint64_t key)
{
  const auto gather = [](std::uint64_t bits) {
    bits &= 0x1249249249249249u;
    bits = (bits | bits >> 2) & 0x10c30c30c30c30c3u;
    bits = (bits | bits >> 4) & 0x100f00f00f00f00fu;
    bits = (bits | bits >> 8) & 0x001f0000ff0000ffu;
    bits = (bits | bits >> 16) & 0x001f00000000ffffu;
    bits = (bits | bits >> 32) & 0x00000000001fffffu;
    return static_cast<int>(bits);
  };
  return {gather(key), gather(key >> 1), gather(key >> 2)};
}

} // namespace pcl_flashreg
