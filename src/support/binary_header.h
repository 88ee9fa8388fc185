// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/byte_order.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace pcl_flashreg {

/** \brief Arrays in files begin at multiples of this many bytes. */
constexpr std::size_t FILE_ALIGNMENT = 64;

inline std::size_t
alignedInFile(std::size_t size)
{
  return (size + FILE_ALIGNMENT - 1) / FILE_ALIGNMENT * FILE_ALIGNMENT;
}

/** \brief The first member of every header; what follows it are numbers of eight bytes. */
struct FileBeginning {
  static constexpr std::uint32_t BYTE_ORDER_MARK = 0x01020304;
  static constexpr std::size_t MAGIC_SIZE = 8;

  char magic[MAGIC_SIZE];
  std::uint32_t version;
  std::uint32_t byte_order;

  static FileBeginning
  of(std::string_view magic, std::uint32_t version)
  {
    FileBeginning beginning = {};
    std::copy_n(magic.data(), MAGIC_SIZE, beginning.magic);
    beginning.version = version;
    beginning.byte_order = BYTE_ORDER_MARK;
    return beginning;
  }
};
static_assert(sizeof(FileBeginning) == 16, "no padding: the bytes are the format");

/** \brief To the order of the file's bytes, and back. */
template <typename Header>
Header
swappedHeader(Header header)
{
  char* const bytes = reinterpret_cast<char*>(&header);
  constexpr std::size_t WORDS = FileBeginning::MAGIC_SIZE,
                        LONGS = sizeof(FileBeginning);
  swapToLittleEndian(bytes + WORDS, LONGS - WORDS, 4);
  swapToLittleEndian(bytes + LONGS, sizeof(header) - LONGS, 8);
  return header;
}

/** \brief The header of a file, in this machine's order.
 * \tparam Error what is thrown if it is not the one that is wanted
 * \param[in] is_none said of a file that begins otherwise */
template <typename Header, typename Error>
Header
readHeader(std::string_view bytes,
           std::string_view magic,
           std::uint32_t version,
           const char* is_none)
{
  if (bytes.substr(0, FileBeginning::MAGIC_SIZE) != magic)
    throw Error(is_none);
  if (bytes.size() < sizeof(Header))
    throw Error("is incomplete: it ends within its header");
  Header header;
  std::memcpy(&header, bytes.data(), sizeof(header));
  header = swappedHeader(header);
  if (header.beginning.byte_order != FileBeginning::BYTE_ORDER_MARK)
    throw Error("comes from a machine of another byte order, or is damaged");
  if (header.beginning.version != version)
    throw Error("has format " + std::to_string(header.beginning.version) +
                ", this version of the library reads format " +
                std::to_string(version));
  return header;
}

} // namespace pcl_flashreg
