// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief A cell's number and the index of what lies in it. */
struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
};

inline std::uint64_t
keyOf(const KeyedIndex& item)
{
  return item.key;
}

inline std::uint64_t
keyOf(std::uint64_t item)
{
  return item;
}

/** \brief Sorts by key, stably; only the lowest `bits` bits of the keys count. Passes of 11
 * bits: three of them sort what a comparison sort takes some fifteen for. */
template <typename Item>
void
radixSort(std::vector<Item>& items, int bits)
{
  constexpr int DIGIT = 11;
  constexpr std::uint64_t BUCKETS = 1 << DIGIT;
  std::vector<Item> sorted(items.size());
  for (int shift = 0; shift < bits; shift += DIGIT) {
    std::size_t begin[BUCKETS] = {};
    for (const Item& item : items)
      ++begin[keyOf(item) >> shift & (BUCKETS - 1)];
    std::size_t sum = 0;
    for (std::size_t& first : begin) {
      const std::size_t count = first;
      first = sum;
      sum += count;
    }
    for (const Item& item : items)
      sorted[begin[keyOf(item) >> shift & (BUCKETS - 1)]++] = item;
    items.swap(sorted);
  }
}

} // namespace pcl_flashreg
