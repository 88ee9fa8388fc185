// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The hot loops of every variant that this machine has, one by one.

#include "support/aligned_buffer.h"
#include "estimation/cpu/bits.h"
#include "simd/kernels.h"
#include "support/made_correspondences.h"

#include <gtest/gtest.h>

#include <bitset>

namespace pcl_flashreg {
namespace cpu {
namespace {

class EveryVariant : public testing::TestWithParam<std::size_t> {
protected:
  const Kernels&
  kernels() const
  {
    std::size_t count = 0;
    return *availableKernels(count)[GetParam()];
  }
};

std::size_t
numberOfVariants()
{
  std::size_t count = 0;
  availableKernels(count);
  return count;
}

/** \brief Rows of random bits, 64-byte aligned. */
void
fill(AlignedBuffer<std::uint64_t>& rows, std::size_t words, int seed)
{
  made::Random random(seed);
  rows.resize(words);
  for (std::uint64_t& word : rows)
    word = random.next() & random.next();
}

TEST_P(EveryVariant, TransposesBits)
{
  made::Random random(1);
  std::uint64_t block[64], original[64];
  for (int i = 0; i < 64; ++i)
    block[i] = original[i] = random.next();
  kernels().transpose(block);
  for (int i = 0; i < 64; ++i)
    for (int j = 0; j < 64; ++j)
      ASSERT_EQ((block[i] >> j) & 1, (original[j] >> i) & 1);
}

TEST_P(EveryVariant, CountsCommonNeighbours)
{
  constexpr std::size_t STRIDE = 24, ROWS = 11;
  AlignedBuffer<std::uint64_t> matrix;
  fill(matrix, STRIDE * ROWS, 2);
  for (const std::size_t words : {1, 2, 3, 7, 8, 9, 15, 16, 24}) {
    AlignedBuffer<std::uint64_t> row;
    fill(row, STRIDE, 3);
    std::fill(row.begin() + words, row.end(), 0);
    for (std::size_t count = 0; count <= ROWS; ++count) {
      std::vector<std::uint32_t> rows, common(ROWS, 12345);
      for (std::size_t i = 0; i < count; ++i)
        rows.push_back(static_cast<std::uint32_t>((7 * i + 3) % ROWS));
      kernels().commonNeighbours(
          row.data(), matrix.data(), STRIDE, words, rows.data(), count, common.data());
      for (std::size_t i = 0; i < ROWS; ++i) {
        std::size_t expected = i < count ? 0 : 12345;
        for (std::size_t w = 0; i < count && w < words; ++w)
          expected += std::bitset<64>(row[w] & matrix[rows[i] * STRIDE + w]).count();
        ASSERT_EQ(common[i], expected)
            << words << " words, row " << i << " of " << count;
      }
    }
  }
}

TEST_P(EveryVariant, CountsBits)
{
  AlignedBuffer<std::uint64_t> words;
  fill(words, 37, 4);
  std::size_t expected = 0;
  for (std::size_t n = 0; n <= 37; ++n) {
    EXPECT_EQ(kernels().countBits(words.data(), n), expected);
    if (n < 37)
      expected += std::bitset<64>(words[n]).count();
  }
}

TEST_P(EveryVariant, IntersectsWithRanks)
{
  constexpr std::size_t WORDS = 6;
  AlignedBuffer<std::uint64_t> a, b;
  fill(a, WORDS, 5);
  fill(b, WORDS, 6);
  const auto bit = [](const AlignedBuffer<std::uint64_t>& row, std::uint32_t i) {
    return (row[i / 64] >> (i % 64)) & 1;
  };
  for (const std::uint32_t after : {0u, 1u, 63u, 64u, 100u, 383u}) {
    std::vector<std::uint32_t> bits(64 * WORDS), ranks_a(bits), ranks_b(bits);
    const std::size_t count = kernels().intersect(a.data(),
                                                  b.data(),
                                                  after / 64,
                                                  WORDS,
                                                  bitsAbove(after % 64),
                                                  bits.data(),
                                                  ranks_a.data(),
                                                  ranks_b.data());
    std::size_t found = 0;
    std::uint32_t rank_a = 0, rank_b = 0;
    for (std::uint32_t i = after + 1; i < 64 * WORDS; ++i) {
      if (bit(a, i) && bit(b, i)) {
        ASSERT_LT(found, count);
        ASSERT_EQ(bits[found], i);
        ASSERT_EQ(ranks_a[found], rank_a);
        ASSERT_EQ(ranks_b[found], rank_b);
        ++found;
      }
      rank_a += static_cast<std::uint32_t>(bit(a, i));
      rank_b += static_cast<std::uint32_t>(bit(b, i));
    }
    EXPECT_EQ(found, count);
  }
}

TEST(Bits, CopiesTheFirstSetBits)
{
  AlignedBuffer<std::uint64_t> row, copy;
  fill(row, 16, 7);
  copy.resize(16);
  for (const std::size_t limit : {1, 2, 15, 16, 17, 64, 200}) {
    const std::size_t used = copyFirstBits(row.data(), limit, copy.data());
    std::size_t seen = 0;
    for (std::size_t i = 0; i < 64 * used; ++i) {
      const bool set = (row[i / 64] >> (i % 64)) & 1;
      const bool copied = (copy[i / 64] >> (i % 64)) & 1;
      ASSERT_EQ(copied, set && seen < limit) << limit << ": bit " << i;
      seen += set;
    }
    ASSERT_GE(seen, limit);
    for (std::size_t w = used; w % 8 != 0; ++w)
      ASSERT_EQ(copy[w], 0u);
  }
}

INSTANTIATE_TEST_SUITE_P(Kernels,
                         EveryVariant,
                         testing::Range(std::size_t{0}, numberOfVariants()),
                         [](const auto& test) {
                           std::size_t count = 0;
                           return std::string(
                               availableKernels(count)[test.param]->name);
                         });

} // namespace
} // namespace cpu
} // namespace pcl_flashreg
