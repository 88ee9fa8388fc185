// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Plain C++ for any processor. It takes the exact formulas throughout, so that it is also
// what the other variants are compared with.

#include "simd/simd_kernels.h"
#include "simd/surface_kernels.h"
#include "math/compatibility.h"
#include "math/residual.h"

namespace pcl_flashreg {
namespace cpu {
namespace {

inline std::uint64_t
countBits(std::uint64_t x)
{
  x -= (x >> 1) & 0x5555555555555555ull;
  x = (x & 0x3333333333333333ull) + ((x >> 2) & 0x3333333333333333ull);
  x = (x + (x >> 4)) & 0x0F0F0F0F0F0F0F0Full;
  return (x * 0x0101010101010101ull) >> 56;
}

/** \brief One float at a time. */
struct OneLane {
  using Float = float;
  using Unaligned = float;
  using Mask = bool;
  static constexpr std::size_t WIDTH = 1;

  static Float
  gather(const float* base, const std::uint32_t* indices)
  {
    return base[*indices];
  }
  static Float
  broadcast(float x)
  {
    return x;
  }
  static Float
  sqrt(Float a)
  {
    return __builtin_sqrtf(a);
  }
  static Float
  abs(Float a)
  {
    return __builtin_fabsf(a);
  }
  static Mask
  less(Float a, Float b)
  {
    return a < b;
  }
  static Mask
  both(Mask a, Mask b)
  {
    return a && b;
  }
  static std::uint32_t
  bits(Mask mask)
  {
    return mask ? 1 : 0;
  }
  static Mask
  firstLanes(std::size_t n)
  {
    return n > 0;
  }
  static Float
  select(Mask mask, Float a, Float b)
  {
    return mask ? a : b;
  }
  static std::size_t
  compress(
      Mask mask, std::uint32_t first, Float value, std::uint32_t* index, float* out)
  {
    *index = first;
    *out = value;
    return mask ? 1 : 0;
  }
  static void
  storeTruncated(std::int32_t* out, Float a)
  {
    *out = static_cast<std::int32_t>(a);
  }
  static std::uint64_t
  commonBits(const std::uint64_t* a, const std::uint64_t* b, std::size_t words)
  {
    std::uint64_t sum = 0;
    for (std::size_t w = 0; w < words; ++w)
      sum += countBits(a[w] & b[w]);
    return sum;
  }
};

template <bool UPRIGHT>
void
edgeTest(const EdgeTestInput& in,
         std::size_t row0,
         std::size_t column0,
         std::uint64_t sure[64],
         std::uint64_t possible[64])
{
  for (std::size_t r = 0; r < 64; ++r) {
    const std::size_t i = row0 + r;
    const PointPair a{in.sx[i], in.sy[i], in.sz[i], in.tx[i], in.ty[i], in.tz[i]};
    std::uint64_t edges = 0;
    for (std::size_t c = 0; c < 64; ++c) {
      const std::size_t j = column0 + c;
      const PointPair b{in.sx[j], in.sy[j], in.sz[j], in.tx[j], in.ty[j], in.tz[j]};
      bool edge = compatible(a, b, in.length_tolerance, in.min_length_sum);
      if constexpr (UPRIGHT)
        edge = edge &&
               keepsHeight(
                   a, b, in.rise[i], in.rise[j], in.length_tolerance, in.squared_slope);
      edges |= static_cast<std::uint64_t>(edge) << c;
    }
    sure[r] = possible[r] = edges;
  }
}

/** \brief Leaves the decision to whoever knows the exact limit: every correspondence that
 * is not clearly out is possible, none is sure. */
void
residualTest(const ResidualInput& in,
             std::size_t first_word,
             std::size_t words,
             std::uint64_t* sure,
             std::uint64_t* possible)
{
  PoseF T;
  for (int k = 0; k < 9; ++k)
    T.r[k] = in.r[k];
  for (int k = 0; k < 3; ++k)
    T.t[k] = in.t[k];
  for (std::size_t word = 0; word < words; ++word) {
    sure[word] = possible[word] = 0;
    for (std::size_t c = 0; c < 64; ++c) {
      const std::size_t i = 64 * (first_word + word) + c;
      const float squared = squaredResidual(
          T, {in.sx[i], in.sy[i], in.sz[i], in.tx[i], in.ty[i], in.tz[i]});
      possible[word] |= static_cast<std::uint64_t>(squared < in.possible) << c;
    }
  }
}

void
featureCandidates(const FeatureBlock& in,
                  std::size_t block,
                  const QueryRows& queries,
                  std::uint32_t* candidates)
{
  const float* targets = in.targets + block * in.dimension * FEATURE_BLOCK;
  const float* norms = in.target_norms + block * FEATURE_BLOCK;
  for (std::size_t q = 0; q < QUERY_BLOCK; ++q) {
    float products[FEATURE_BLOCK] = {};
    for (std::size_t d = 0; d < in.dimension; ++d)
      for (std::size_t i = 0; i < FEATURE_BLOCK; ++i)
        products[i] +=
            queries.values[q * in.dimension + d] * targets[d * FEATURE_BLOCK + i];
    candidates[q] = 0;
    for (std::size_t i = 0; i < FEATURE_BLOCK; ++i) {
      const float distance = norms[i] - 2.0f * products[i];
      candidates[q] |= static_cast<std::uint32_t>(distance < queries.thresholds[q])
                       << i;
    }
  }
}

} // namespace

extern const Kernels SCALAR_KERNELS;
const Kernels SCALAR_KERNELS = {"scalar",
                                &edgeTest<false>,
                                &edgeTest<true>,
                                &transposeBits,
                                &commonNeighboursSimd<OneLane>,
                                &countBitsIn,
                                &intersectRows,
                                &residualTest,
                                &featureCandidates,
                                &collectNeighborsSimd<OneLane>,
                                &momentSumsSimd<OneLane>,
                                &pairHistogramSimd<OneLane>,
                                &weightedRowSumSimd<OneLane>};

} // namespace cpu
} // namespace pcl_flashreg
