// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// NEON, which every AArch64 processor has.

#include "cpu/kernels/simd_kernels.h"

#include <arm_neon.h>

namespace pcl_flashreg {
namespace cpu {
namespace {

struct Neon {
  using Float = float32x4_t;
  using Mask = uint32x4_t;
  static constexpr std::size_t WIDTH = 4;
  static constexpr std::size_t QUERY_ROWS = 4;
  static constexpr std::size_t FEATURE_GROUPS = 4;

  static Float
  load(const float* p)
  {
    return vld1q_f32(p);
  }
  static Float
  broadcast(float x)
  {
    return vdupq_n_f32(x);
  }
  static Float
  add(Float a, Float b)
  {
    return vaddq_f32(a, b);
  }
  static Float
  sub(Float a, Float b)
  {
    return vsubq_f32(a, b);
  }
  static Float
  mul(Float a, Float b)
  {
    return vmulq_f32(a, b);
  }
  static Float
  fma(Float a, Float b, Float c)
  {
    return vfmaq_f32(c, a, b);
  }
  static Mask
  less(Float a, Float b)
  {
    return vcltq_f32(a, b);
  }
  static Mask
  lessAnd(Mask mask, Float a, Float b)
  {
    return vandq_u32(mask, vcltq_f32(a, b));
  }
  static Mask
  greaterAnd(Mask mask, Float a, Float b)
  {
    return vandq_u32(mask, vcgtq_f32(a, b));
  }
  static std::uint32_t
  bits(Mask mask)
  {
    const uint32x4_t lane_bits = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32(mask, lane_bits));
  }
  /** \brief Groups come in ascending order, so the first clears the word. */
  static void
  store(Mask mask, std::uint64_t* words, std::size_t group)
  {
    const std::uint64_t lanes = static_cast<std::uint64_t>(bits(mask)) << (4 * group);
    *words = group == 0 ? lanes : *words | lanes;
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
    uint64x2_t sum = vdupq_n_u64(0);
    for (std::size_t w = 0; w < words; w += 2) {
      const uint64x2_t both = vandq_u64(vld1q_u64(row + w), vld1q_u64(other + w));
      const uint8x16_t bytes = vcntq_u8(vreinterpretq_u8_u64(both));
      sum = vpadalq_u32(sum, vpaddlq_u16(vpaddlq_u8(bytes)));
    }
    common[n] = static_cast<std::uint32_t>(vaddvq_u64(sum));
  }
}

} // namespace

extern const Kernels NEON_KERNELS;
const Kernels NEON_KERNELS = {"neon",
                              &edgeTestSimd<Neon>,
                              &transposeBits,
                              &commonNeighbours,
                              &countBitsIn,
                              &intersectRows,
                              &residualTestSimd<Neon>,
                              &featureCandidatesSimd<Neon>};

} // namespace cpu
} // namespace pcl_flashreg
