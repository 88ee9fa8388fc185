// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// AVX2, FMA and POPCNT (Haswell and Zen on).

#include "simd/kernel_table.h"

#include <immintrin.h>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief The positions of the bits set in a byte, a byte each, lowest first. */
struct SetBits {
  std::uint64_t of[256] = {};

  constexpr SetBits()
  {
    for (std::uint32_t byte = 0; byte < 256; ++byte) {
      std::uint32_t count = 0;
      for (std::uint64_t bit = 0; bit < 8; ++bit)
        if (byte >> bit & 1)
          of[byte] |= bit << (8 * count++);
    }
  }
};
constexpr SetBits SET_BITS;

struct Avx2 {
  using Float = __m256;
  using Unaligned = __m256_u;
  using Mask = __m256;
  static constexpr std::size_t WIDTH = 8;
  static constexpr std::size_t QUERY_ROWS = 4;
  static constexpr std::size_t FEATURE_GROUPS = 2;

  static Float
  broadcast(float x)
  {
    return _mm256_set1_ps(x);
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
  static std::uint32_t
  bits(Mask mask)
  {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(mask));
  }
  static Float
  gather(const float* base, const std::uint32_t* indices)
  {
    const auto* vector = reinterpret_cast<const __m256i*>(indices);
    return _mm256_i32gather_ps(base, _mm256_loadu_si256(vector), sizeof(float));
  }
  static Float
  sqrt(Float a)
  {
    return _mm256_sqrt_ps(a);
  }
  static Float
  abs(Float a)
  {
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0f), a);
  }
  static Float
  select(Mask mask, Float a, Float b)
  {
    return _mm256_blendv_ps(b, a, mask);
  }
  static Mask
  both(Mask a, Mask b)
  {
    return _mm256_and_ps(a, b);
  }
  static Mask
  firstLanes(std::size_t n)
  {
    const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    return _mm256_castsi256_ps(
        _mm256_cmpgt_epi32(_mm256_set1_epi32(static_cast<int>(n)), lanes));
  }
  static std::size_t
  compress(
      Mask mask, std::uint32_t first, Float values, std::uint32_t* indices, float* out)
  {
    const std::uint32_t lanes = bits(mask);
    const __m256i order = _mm256_cvtepu8_epi32(
        _mm_cvtsi64_si128(static_cast<long long>(SET_BITS.of[lanes])));
    const __m256i numbers =
        _mm256_add_epi32(order, _mm256_set1_epi32(static_cast<int>(first)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(indices), numbers);
    _mm256_storeu_ps(out, _mm256_permutevar8x32_ps(values, order));
    return static_cast<std::size_t>(_mm_popcnt_u32(lanes));
  }
  static void
  storeTruncated(std::int32_t* out, Float a)
  {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(out), _mm256_cvttps_epi32(a));
  }
  static void
  store(Mask mask, std::uint64_t* words, std::size_t group)
  {
    reinterpret_cast<unsigned char*>(words)[group] =
        static_cast<unsigned char>(_mm256_movemask_ps(mask));
  }
  static std::uint64_t
  commonBits(const std::uint64_t* a, const std::uint64_t* b, std::size_t words)
  {
    std::uint64_t even = 0, odd = 0;
    for (std::size_t w = 0; w < words; w += 4) {
      even += static_cast<std::uint64_t>(_mm_popcnt_u64(a[w] & b[w])) +
              static_cast<std::uint64_t>(_mm_popcnt_u64(a[w + 1] & b[w + 1]));
      odd += static_cast<std::uint64_t>(_mm_popcnt_u64(a[w + 2] & b[w + 2])) +
             static_cast<std::uint64_t>(_mm_popcnt_u64(a[w + 3] & b[w + 3]));
    }
    return even + odd;
  }
};

} // namespace

extern const Kernels AVX2_KERNELS;
constexpr Kernels AVX2_KERNELS = simdKernels<Avx2>("avx2", &commonNeighboursSimd<Avx2>);

} // namespace cpu
} // namespace pcl_flashreg
