// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// AVX-512 F, BW, DQ, VL and VPOPCNTDQ (Ice Lake and Zen 4 on).

#include "simd/kernel_table.h"

#include <immintrin.h>

namespace pcl_flashreg {
namespace cpu {
namespace {

struct Avx512 {
  using Float = __m512;
  using Unaligned = __m512_u;
  using Mask = __mmask16;
  static constexpr std::size_t WIDTH = 16;
  static constexpr std::size_t QUERY_ROWS = 8;
  static constexpr std::size_t FEATURE_GROUPS = 2;

  static Float
  broadcast(float x)
  {
    return _mm512_set1_ps(x);
  }
  static Float
  fma(Float a, Float b, Float c)
  {
    return _mm512_fmadd_ps(a, b, c);
  }
  static Mask
  less(Float a, Float b)
  {
    return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ);
  }
  static Mask
  lessAnd(Mask mask, Float a, Float b)
  {
    return _mm512_mask_cmp_ps_mask(mask, a, b, _CMP_LT_OQ);
  }
  static std::uint32_t
  bits(Mask mask)
  {
    return mask;
  }
  static Float
  gather(const float* base, const std::uint32_t* indices)
  {
    return _mm512_i32gather_ps(_mm512_loadu_si512(indices), base, sizeof(float));
  }
  static Float
  sqrt(Float a)
  {
    return _mm512_sqrt_ps(a);
  }
  static Float
  abs(Float a)
  {
    return _mm512_abs_ps(a);
  }
  static Float
  select(Mask mask, Float a, Float b)
  {
    return _mm512_mask_blend_ps(mask, b, a);
  }
  static Mask
  both(Mask a, Mask b)
  {
    return static_cast<Mask>(a & b);
  }
  static Mask
  firstLanes(std::size_t n)
  {
    return static_cast<Mask>((1u << n) - 1);
  }
  static std::size_t
  compress(
      Mask mask, std::uint32_t first, Float values, std::uint32_t* indices, float* out)
  {
    const __m512i lanes =
        _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    const __m512i numbers =
        _mm512_add_epi32(lanes, _mm512_set1_epi32(static_cast<int>(first)));
    // Into a register and from there: compressing to memory is slow on some processors.
    _mm512_storeu_si512(indices, _mm512_maskz_compress_epi32(mask, numbers));
    _mm512_storeu_ps(out, _mm512_maskz_compress_ps(mask, values));
    return static_cast<std::size_t>(_mm_popcnt_u32(mask));
  }
  static void
  storeTruncated(std::int32_t* out, Float a)
  {
    _mm512_storeu_si512(out, _mm512_cvttps_epi32(a));
  }
  static void
  store(Mask mask, std::uint64_t* words, std::size_t group)
  {
    const std::uint16_t value = mask;
    __builtin_memcpy(reinterpret_cast<char*>(words) + 2 * group, &value, 2);
  }
};

inline __m512i
commonBits(__m512i row, const std::uint64_t* other)
{
  return _mm512_popcnt_epi64(_mm512_and_si512(row, _mm512_load_si512(other)));
}

void
commonNeighbours(const std::uint64_t* row,
                 const std::uint64_t* matrix,
                 std::size_t stride,
                 std::size_t words,
                 const std::uint32_t* rows,
                 std::size_t count,
                 std::uint32_t* common)
{
  std::size_t n = 0;
  for (; n + 4 <= count; n += 4) {
    const std::uint64_t* r0 = matrix + rows[n] * stride;
    const std::uint64_t* r1 = matrix + rows[n + 1] * stride;
    const std::uint64_t* r2 = matrix + rows[n + 2] * stride;
    const std::uint64_t* r3 = matrix + rows[n + 3] * stride;
    __m512i c0 = _mm512_setzero_si512(), c1 = c0, c2 = c0, c3 = c0;
    for (std::size_t w = 0; w < words; w += 8) {
      const __m512i mine = _mm512_load_si512(row + w);
      c0 = _mm512_add_epi64(c0, commonBits(mine, r0 + w));
      c1 = _mm512_add_epi64(c1, commonBits(mine, r1 + w));
      c2 = _mm512_add_epi64(c2, commonBits(mine, r2 + w));
      c3 = _mm512_add_epi64(c3, commonBits(mine, r3 + w));
    }
    // Counts fit 32 bits: pairs of rows share a register, then all four.
    const __m512i c01 = _mm512_or_si512(c0, _mm512_slli_epi64(c1, 32));
    const __m512i c23 = _mm512_or_si512(c2, _mm512_slli_epi64(c3, 32));
    const __m512i low = _mm512_unpacklo_epi64(c01, c23);
    const __m512i high = _mm512_unpackhi_epi64(c01, c23);
    const __m512i quads = _mm512_add_epi32(low, high);
    const __m256i octet = _mm256_add_epi32(_mm512_castsi512_si256(quads),
                                           _mm512_extracti64x4_epi64(quads, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(common + n),
                     _mm_add_epi32(_mm256_castsi256_si128(octet),
                                   _mm256_extracti128_si256(octet, 1)));
  }
  for (; n < count; ++n) {
    const std::uint64_t* other = matrix + rows[n] * stride;
    __m512i sum = _mm512_setzero_si512();
    for (std::size_t w = 0; w < words; w += 8)
      sum = _mm512_add_epi64(sum, commonBits(_mm512_load_si512(row + w), other + w));
    common[n] = static_cast<std::uint32_t>(_mm512_reduce_add_epi64(sum));
  }
}

} // namespace

extern const Kernels AVX512_KERNELS;
constexpr Kernels AVX512_KERNELS = simdKernels<Avx512>("avx512", &commonNeighbours);

} // namespace cpu
} // namespace pcl_flashreg
