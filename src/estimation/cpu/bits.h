// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>

namespace pcl_flashreg {
namespace cpu {

/** \brief The bits of a word above bit i. */
inline std::uint64_t
bitsAbove(unsigned i)
{
  return i == 63 ? 0 : ~std::uint64_t{0} << (i + 1);
}

/** \brief Lists the bits above bit i in the words [begin, end), ascending.
 * \param[out] indices room for as many as there are
 * \return how many
 */
inline std::size_t
listBitsAbove(const std::uint64_t* row,
              std::uint32_t i,
              std::size_t begin,
              std::size_t end,
              std::uint32_t* indices)
{
  const std::size_t first = i / 64;
  std::size_t count = 0;
  for (std::size_t w = begin > first ? begin : first; w < end; ++w)
    for (std::uint64_t bits = w == first ? row[w] & bitsAbove(i % 64) : row[w];
         bits != 0;
         bits &= bits - 1)
      indices[count++] = static_cast<std::uint32_t>(64 * w) +
                         static_cast<std::uint32_t>(__builtin_ctzll(bits));
  return count;
}

/** \brief Lists the bits set in n words, ascending. */
template <typename Index>
void
listBits(const std::uint64_t* words, std::size_t n, Index* indices)
{
  for (std::size_t w = 0; w < n; ++w)
    for (std::uint64_t bits = words[w]; bits != 0; bits &= bits - 1)
      *indices++ =
          static_cast<Index>(64 * w) + static_cast<Index>(__builtin_ctzll(bits));
}

/** \brief Copies the first `limit` bits of a row that has more, and zeros up to the next
 * multiple of 8 words.
 * \return number of words up to the last bit copied
 */
inline std::size_t
copyFirstBits(const std::uint64_t* row, std::size_t limit, std::uint64_t* copy)
{
  std::size_t w = 0;
  for (std::size_t open = limit; open > 0; ++w) {
    std::uint64_t rest = row[w];
    for (; rest != 0 && open > 0; --open)
      rest &= rest - 1;
    copy[w] = row[w] & ~rest;
  }
  const std::size_t used = w;
  for (; w % 8 != 0; ++w)
    copy[w] = 0;
  return used;
}

} // namespace cpu
} // namespace pcl_flashreg
