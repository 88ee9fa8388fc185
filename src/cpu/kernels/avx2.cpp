// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// AVX2, FMA and POPCNT (Haswell and Zen on).

#include "cpu/kernels/simd_kernels.h"

#include <immintrin.h>

namespace pcl_flashreg {
namespace cpu {
namespace {

struct Avx2 {
  using Float = __m256;
  using Mask = __m256;
  static constexpr std::size_t WIDTH = 8;
  static constexpr std::size_t QUERY_ROWS = 4;
  static constexpr std::size_t FEATURE_GROUPS = 2;

  static Float
  load(const float* p)
  {
    return _mm256_load_ps(p);
  }
  static Float
  broadcast(float x)
  {
    return _mm256_set1_ps(x);
  }
  static Float
  add(Float a, Float b)
  {
    return _mm256_add_ps(a, b);
  }
  static Float
  sub(Float a, Float b)
  {
    return _mm256_sub_ps(a, b);
  }
  static Float
  mul(Float a, Float b)
  {
    return _mm256_mul_ps(a, b);
  }
  static Float
  fma(Float a, Float b, Float c)
  {
    return _mm256_fmadd_ps(a, b, c);
  }
  static Mask
  less(Float a, Float b)
  {
    return _mm256_cmp_ps(a, b, _CMP_LT_OQ);
  }
  static Mask
  lessAnd(Mask mask, Float a, Float b)
  {
    return _mm256_and_ps(mask, _mm256_cmp_ps(a, b, _CMP_LT_OQ));
  }
  static Mask
  greaterAnd(Mask mask, Float a, Float b)
  {
    return _mm256_and_ps(mask, _mm256_cmp_ps(a, b, _CMP_GT_OQ));
  }
  static std::uint32_t
  bits(Mask mask)
  {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
  }
  static void
  store(Mask mask, std::uint64_t* words, std::size_t group)
  {
    reinterpret_cast<unsigned char*>(words)[group] =
        static_cast<unsigned char>(_mm256_movemask_ps(mask));
  }
};

void
commonNeighbours(const std::uint64_t* row,
                 const std::uint64_t* matrix,
                 std::size_t stride,
                 std::size_t words,
                 const std::uint32_t* rows,
                 std::size_t count,
                 std::uint32_t* common)
{
  for (std::size_t n = 0; n < count; ++n) {
    const std::uint64_t* other = matrix + rows[n] * stride;
    std::uint64_t even = 0, odd = 0;
    for (std::size_t w = 0; w < words; w += 4) {
      even += static_cast<std::uint64_t>(_mm_popcnt_u64(row[w] & other[w])) +
              static_cast<std::uint64_t>(_mm_popcnt_u64(row[w + 1] & other[w + 1]));
      odd += static_cast<std::uint64_t>(_mm_popcnt_u64(row[w + 2] & other[w + 2])) +
             static_cast<std::uint64_t>(_mm_popcnt_u64(row[w + 3] & other[w + 3]));
    }
    common[n] = static_cast<std::uint32_t>(even + odd);
  }
}

} // namespace

extern const Kernels AVX2_KERNELS;
const Kernels AVX2_KERNELS = {"avx2",
                              &edgeTestSimd<Avx2>,
                              &transposeBits,
                              &commonNeighbours,
                              &countBitsIn,
                              &intersectRows,
                              &residualTestSimd<Avx2>,
                              &featureCandidatesSimd<Avx2>};

} // namespace cpu
} // namespace pcl_flashreg
