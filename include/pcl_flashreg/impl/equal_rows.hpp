// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

namespace pcl_flashreg {
namespace detail {

/** \brief Which rows of floats are equal, so that a search need take each but once: made
 * scenes have thousands of equal descriptors, and what a sensor did not see is often
 * stored as thousands of equal points. Found by a hash, at the cost of reading them. */
class EqualRows {
public:
  /** \brief Ends a chain of next(). */
  static constexpr std::uint32_t NONE = std::numeric_limits<std::uint32_t>::max();

  EqualRows() = default;

  /** \param[in] count number of rows, < 2^31
   * \param[in] length floats in a row
   * \param[in] row i -> const float*; finite values, i in [0, count) */
  template <typename RowAt>
  EqualRows(std::size_t count, std::size_t length, const RowAt& row)
  {
    std::vector<std::uint64_t> hashes(count);
    for (std::size_t i = 0; i < count; ++i)
      hashes[i] = hashOf(row(i), length);
    int bits = 1;
    while (std::size_t{1} << bits < count)
      ++bits;
    // First rows with the same leading bits in their hash follow each other in a chain.
    std::vector<std::uint32_t> heads(std::size_t{1} << bits, NONE), chain(count);
    std::vector<std::uint32_t> lasts;
    firsts_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = static_cast<std::uint32_t>(i);
      std::uint32_t& head = heads[hashes[i] >> (64 - bits)];
      std::uint32_t first = head;
      while (first != NONE &&
             !(hashes[first] == hashes[i] &&
               std::equal(row(i), row(i) + length, row(std::size_t{first}))))
        first = chain[first];
      if (first == NONE) {
        chain[i] = head;
        head = at;
        firsts_.push_back(at);
        continue;
      }
      if (next_.empty()) {
        next_.assign(count, NONE);
        lasts.resize(count);
      }
      next_[next_[first] == NONE ? first : lasts[first]] = at;
      lasts[first] = at;
    }
  }

  /** \brief What firsts() and followers() gave out. */
  EqualRows(std::vector<std::uint32_t> firsts, std::vector<std::uint32_t> followers)
      : firsts_(std::move(firsts)), next_(std::move(followers))
  {
  }

  /** \brief The first of each kind, ascending. */
  const std::vector<std::uint32_t>&
  firsts() const
  {
    return firsts_;
  }

  bool
  allDiffer() const
  {
    return next_.empty();
  }

  /** \brief next() of all rows; empty where all differ. */
  const std::vector<std::uint32_t>&
  followers() const
  {
    return next_;
  }

  /** \brief The next row that equals row i, or NONE. */
  std::uint32_t
  next(std::uint32_t i) const
  {
    return next_.empty() ? NONE : next_[i];
  }

private:
  /** \brief Four lanes side by side: a few nanoseconds for some thirty values. */
  static std::uint64_t
  hashOf(const float* row, std::size_t length)
  {
    constexpr std::size_t LANES = 4;
    std::uint32_t lanes[LANES] = {1, 2, 3, 4};
    const auto add = [&lanes](const float* values) {
      float block[LANES];
      // -0 becomes 0, which it equals.
      for (std::size_t i = 0; i < LANES; ++i)
        block[i] = values[i] + 0.0f;
      std::uint32_t words[LANES];
      std::memcpy(words, block, sizeof(words));
      for (std::size_t i = 0; i < LANES; ++i)
        lanes[i] = (lanes[i] << 5 | lanes[i] >> 27) + words[i];
    };
    if (length < LANES) {
      float block[LANES] = {};
      std::copy(row, row + length, block);
      add(block);
    }
    else {
      for (std::size_t i = 0; i + LANES <= length; i += LANES)
        add(row + i);
      // The last again, where the length is no multiple.
      add(row + length - LANES);
    }
    constexpr std::uint64_t FACTOR = 0x9E3779B97F4A7C15ull;
    std::uint64_t pairs[LANES / 2];
    std::memcpy(pairs, lanes, sizeof(pairs));
    const std::uint64_t hash = ((pairs[0] * FACTOR >> 1) ^ pairs[1]) * FACTOR;
    return (hash ^ (hash >> 32)) * FACTOR;
  }

  std::vector<std::uint32_t> firsts_;
  /** \brief Empty where no two rows are equal. */
  std::vector<std::uint32_t> next_;
};

} // namespace detail
} // namespace pcl_flashreg
