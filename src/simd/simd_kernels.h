// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// The hot loops, written once over a type V that wraps one instruction set's registers of
// floats. Everything stands in an unnamed namespace, and nothing but these headers is
// included, so that no code compiled with instruction-set flags leaks out of its file.
//
// V offers: Float, which compilers give the operators of a float; Unaligned, the same
// wherever floats may stand; Mask; WIDTH; broadcast, fma(a, b, c) = a * b + c; less(a, b),
// lessAnd(mask, a, b), as AVX-512 has it in one; store(mask, words, group), which puts
// WIDTH bits at bit group * WIDTH of the little-endian words.
//
// Products and sums are contracted here on purpose: these tests only decide what is
// certain, and leave the rest to the exact formulas.

#include "simd/kernels.h"

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Floats from an address that is a multiple of the register's size. */
template <typename V>
typename V::Float
loadAligned(const float* p)
{
  return *reinterpret_cast<const typename V::Float*>(p);
}

template <typename V>
typename V::Float
load(const float* p)
{
  return *reinterpret_cast<const typename V::Unaligned*>(p);
}

template <typename V>
void
store(float* p, typename V::Float a)
{
  *reinterpret_cast<typename V::Unaligned*>(p) = a;
}

template <typename V, bool UPRIGHT>
void
edgeTestSimd(const EdgeTestInput& in,
             std::size_t row0,
             std::size_t column0,
             std::uint64_t sure[64],
             std::uint64_t possible[64])
{
  using Float = typename V::Float;
  const Float minus_two_tau2 = V::broadcast(in.minus_two_tau2);
  const Float tau4 = V::broadcast(in.tau4);
  const Float sure_defect = V::broadcast(in.sure_defect);
  const Float possible_defect = V::broadcast(in.possible_defect);
  const Float sure_sum = V::broadcast(in.sure_sum);
  const Float possible_sum = V::broadcast(in.possible_sum);
  const Float minus_two = V::broadcast(-2.0f);
  const Float tolerance = V::broadcast(in.length_tolerance);
  const Float minus_slope = V::broadcast(-in.squared_slope);
  const Float possible_height = V::broadcast(in.height_margin);
  const Float sure_height = V::broadcast(-in.height_margin);

  for (std::size_t group = 0; group < 64 / V::WIDTH; ++group) {
    const std::size_t j = column0 + group * V::WIDTH;
    const Float sx = minus_two * loadAligned<V>(in.sx + j);
    const Float sy = minus_two * loadAligned<V>(in.sy + j);
    const Float sz = minus_two * loadAligned<V>(in.sz + j);
    const Float tx = minus_two * loadAligned<V>(in.tx + j);
    const Float ty = minus_two * loadAligned<V>(in.ty + j);
    const Float tz = minus_two * loadAligned<V>(in.tz + j);
    const Float source_norm = loadAligned<V>(in.source_norm + j);
    const Float target_norm = loadAligned<V>(in.target_norm + j);
    Float rise{};
    if constexpr (UPRIGHT)
      rise = loadAligned<V>(in.rise + j);
    for (std::size_t row = 0; row < 64; ++row) {
      const std::size_t i = row0 + row;
      // a = |s_i - s_j|^2 and b = |t_i - t_j|^2 from norms and inner products.
      Float a = source_norm + V::broadcast(in.source_norm[i]);
      Float b = target_norm + V::broadcast(in.target_norm[i]);
      a = V::fma(sx, V::broadcast(in.sx[i]), a);
      b = V::fma(tx, V::broadcast(in.tx[i]), b);
      a = V::fma(sy, V::broadcast(in.sy[i]), a);
      b = V::fma(ty, V::broadcast(in.ty[i]), b);
      a = V::fma(sz, V::broadcast(in.sz[i]), a);
      b = V::fma(tz, V::broadcast(in.tz[i]), b);
      const Float difference = a - b;
      const Float sum = a + b;
      const Float defect =
          V::fma(difference, difference, V::fma(minus_two_tau2, sum, tau4));
      auto is_possible = V::less(defect, possible_defect);
      is_possible = V::lessAnd(is_possible, possible_sum, sum);
      auto is_sure = V::lessAnd(is_possible, defect, sure_defect);
      is_sure = V::lessAnd(is_sure, sure_sum, sum);
      if constexpr (UPRIGHT) {
        const Float excess = V::abs(rise - V::broadcast(in.rise[i])) - tolerance;
        const Float height = V::fma(excess, V::abs(excess), minus_slope * a);
        is_possible = V::lessAnd(is_possible, height, possible_height);
        is_sure = V::lessAnd(is_sure, height, sure_height);
      }
      V::store(is_possible, possible + row, group);
      V::store(is_sure, sure + row, group);
    }
  }
}

template <typename V>
void
residualTestSimd(const ResidualInput& in,
                 std::size_t first_word,
                 std::size_t words,
                 std::uint64_t* sure,
                 std::uint64_t* possible)
{
  using Float = typename V::Float;
  const Float sure_limit = V::broadcast(in.sure);
  const Float possible_limit = V::broadcast(in.possible);
  Float r[9], t[3];
  for (int k = 0; k < 9; ++k)
    r[k] = V::broadcast(in.r[k]);
  for (int k = 0; k < 3; ++k)
    t[k] = V::broadcast(in.t[k]);

  for (std::size_t word = 0; word < words; ++word)
    for (std::size_t group = 0; group < 64 / V::WIDTH; ++group) {
      const std::size_t i = 64 * (first_word + word) + group * V::WIDTH;
      const Float sx = loadAligned<V>(in.sx + i);
      const Float sy = loadAligned<V>(in.sy + i);
      const Float sz = loadAligned<V>(in.sz + i);
      Float dx = t[0] - loadAligned<V>(in.tx + i);
      Float dy = t[1] - loadAligned<V>(in.ty + i);
      Float dz = t[2] - loadAligned<V>(in.tz + i);
      dx = V::fma(r[0], sx, V::fma(r[1], sy, V::fma(r[2], sz, dx)));
      dy = V::fma(r[3], sx, V::fma(r[4], sy, V::fma(r[5], sz, dy)));
      dz = V::fma(r[6], sx, V::fma(r[7], sy, V::fma(r[8], sz, dz)));
      const Float squared = V::fma(dz, dz, V::fma(dy, dy, dx * dx));
      const auto is_possible = V::less(squared, possible_limit);
      const auto is_sure = V::lessAnd(is_possible, squared, sure_limit);
      V::store(is_possible, possible + word, group);
      V::store(is_sure, sure + word, group);
    }
}

template <typename V>
void
featureCandidatesSimd(const FeatureBlock& in,
                      std::size_t block,
                      const QueryRows& queries,
                      std::uint32_t* candidates)
{
  // As many query rows at a time as the accumulators leave registers for.
  using Float = typename V::Float;
  constexpr std::size_t ROWS = V::QUERY_ROWS;
  constexpr std::size_t GROUPS = V::FEATURE_GROUPS;
  const float* targets = in.targets + block * in.dimension * FEATURE_BLOCK;
  const float* norms = in.target_norms + block * FEATURE_BLOCK;
  const Float minus_two = V::broadcast(-2.0f);
  for (std::size_t q = 0; q < QUERY_BLOCK; ++q)
    candidates[q] = 0;
  for (std::size_t first = 0; first < QUERY_BLOCK; first += ROWS)
    for (std::size_t group = 0; group < FEATURE_BLOCK / V::WIDTH; group += GROUPS) {
      Float products[ROWS][GROUPS];
      for (std::size_t q = 0; q < ROWS; ++q)
        for (std::size_t g = 0; g < GROUPS; ++g)
          products[q][g] = V::broadcast(0.0f);
      for (std::size_t d = 0; d < in.dimension; ++d) {
        Float t[GROUPS];
        for (std::size_t g = 0; g < GROUPS; ++g)
          t[g] = loadAligned<V>(targets + d * FEATURE_BLOCK + (group + g) * V::WIDTH);
        for (std::size_t q = 0; q < ROWS; ++q) {
          const Float value =
              V::broadcast(queries.values[(first + q) * in.dimension + d]);
          for (std::size_t g = 0; g < GROUPS; ++g)
            products[q][g] = V::fma(value, t[g], products[q][g]);
        }
      }
      for (std::size_t q = 0; q < ROWS; ++q)
        for (std::size_t g = 0; g < GROUPS; ++g) {
          const Float norm = loadAligned<V>(norms + (group + g) * V::WIDTH);
          const Float distance = V::fma(minus_two, products[q][g], norm);
          const auto near =
              V::less(distance, V::broadcast(queries.thresholds[first + q]));
          candidates[first + q] |= V::bits(near) << ((group + g) * V::WIDTH);
        }
    }
}

/** \brief Row by row; V offers commonBits(a, b, words), how many bits two rows share. */
template <typename V>
void
commonNeighboursSimd(const std::uint64_t* row,
                     const std::uint64_t* matrix,
                     std::size_t stride,
                     std::size_t words,
                     const std::uint32_t* rows,
                     std::size_t count,
                     std::uint32_t* common)
{
  for (std::size_t n = 0; n < count; ++n)
    common[n] = static_cast<std::uint32_t>(
        V::commonBits(row, matrix + rows[n] * stride, words));
}

// The compiler makes one instruction of a population count where the file's flags allow.

inline std::size_t
countBitsIn(const std::uint64_t* words, std::size_t n)
{
  std::size_t count = 0;
  for (std::size_t w = 0; w < n; ++w)
    count += static_cast<std::size_t>(__builtin_popcountll(words[w]));
  return count;
}

inline std::size_t
intersectRows(const std::uint64_t* a,
              const std::uint64_t* b,
              std::size_t first,
              std::size_t words,
              std::uint64_t mask,
              std::uint32_t* bits,
              std::uint32_t* ranks_a,
              std::uint32_t* ranks_b)
{
  std::size_t count = 0;
  std::uint32_t rank_a = 0, rank_b = 0;
  for (std::size_t w = first; w < words; ++w, mask = ~std::uint64_t{0}) {
    const std::uint64_t bits_a = a[w] & mask, bits_b = b[w] & mask;
    for (std::uint64_t both = bits_a & bits_b; both != 0; both &= both - 1) {
      const std::uint64_t before = (both & (0 - both)) - 1;
      bits[count] = static_cast<std::uint32_t>(64 * w) +
                    static_cast<std::uint32_t>(__builtin_ctzll(both));
      ranks_a[count] =
          rank_a + static_cast<std::uint32_t>(__builtin_popcountll(bits_a & before));
      ranks_b[count] =
          rank_b + static_cast<std::uint32_t>(__builtin_popcountll(bits_b & before));
      ++count;
    }
    rank_a += static_cast<std::uint32_t>(__builtin_popcountll(bits_a));
    rank_b += static_cast<std::uint32_t>(__builtin_popcountll(bits_b));
  }
  return count;
}

/** \brief Transposes by exchanging ever smaller off-diagonal squares; the compiler turns
 * the inner loops into whatever registers it has. */
inline void
transposeBits(std::uint64_t block[64])
{
  std::uint64_t mask = 0x00000000FFFFFFFFull;
  for (unsigned width = 32; width != 0; width >>= 1, mask ^= mask << width)
    for (unsigned base = 0; base < 64; base += 2 * width)
      for (unsigned k = base; k < base + width; ++k) {
        const std::uint64_t swapped = ((block[k] >> width) ^ block[k + width]) & mask;
        block[k] ^= swapped << width;
        block[k + width] ^= swapped;
      }
}

} // namespace
} // namespace cpu
} // namespace pcl_flashreg
