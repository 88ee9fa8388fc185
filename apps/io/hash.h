// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief 64-bit FNV-1a: tells damaged and changed bytes apart,
 * nothing that an adversary made. */
inline std::uint64_t
hashOf(std::string_view bytes)
{
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char byte : bytes) {
    hash ^= static_cast<unsigned char>(byte);
    hash *= 0x100000001b3u;
  }
  return hash;
}

/** \brief 16 hexadecimal digits. */
inline std::string
toHex(std::uint64_t value)
{
  std::string text(16, '0');
  for (int digit = 15; digit >= 0; --digit, value >>= 4)
    text[static_cast<std::size_t>(digit)] = "0123456789abcdef"[value & 15];
  return text;
}

} // namespace pcl_flashreg::io
