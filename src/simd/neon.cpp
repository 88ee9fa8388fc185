// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// NEON, which every AArch64 processor has.

#include "simd/kernel_table.h"

#include <arm_neon.h>

namespace pcl_flashreg {
namespace cpu {
namespace {

struct Neon {
  using Float = float32x4_t;
  using Unaligned __attribute__((aligned(4))) = Float;
  using Mask = uint32x4_t;
  static constexpr std::size_t WIDTH = 4;
  static constexpr std::size_t QUERY_ROWS = 4;
  static constexpr std::size_t FEATURE_GROUPS = 4;

  static Float
  broadcast(float x)
  {
    return vdupq_n_f32(x);
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
  static std::uint32_t
  bits(Mask mask)
  {
    const uint32x4_t lane_bits = {1, 2, 4, 8};
    return vaddvq_u32(vandq_u32(mask, lane_bits));
  }
  static Float
  gather(const float* base, const std::uint32_t* indices)
  {
    const Float values = {
        base[indices[0]], base[indices[1]], base[indices[2]], base[indices[3]]};
    return values;
  }
  static Float
  sqrt(Float a)
  {
    return vsqrtq_f32(a);
  }
  static Float
  abs(Float a)
  {
    return vabsq_f32(a);
  }
  static Float
  select(Mask mask, Float a, Float b)
  {
    return vbslq_f32(mask, a, b);
  }
  static Mask
  both(Mask a, Mask b)
  {
    return vandq_u32(a, b);
  }
  static Mask
  firstLanes(std::size_t n)
  {
    const uint32x4_t lanes = {0, 1, 2, 3};
    return vcltq_u32(lanes, vdupq_n_u32(static_cast<std::uint32_t>(n)));
  }
  static std::size_t
  compress(
      Mask mask, std::uint32_t first, Float values, std::uint32_t* indices, float* out)
  {
    float all[WIDTH];
    vst1q_f32(all, values);
    const std::uint32_t lanes = bits(mask);
    std::size_t count = 0;
    for (std::uint32_t lane = 0; lane < WIDTH; ++lane) {
      indices[count] = first + lane;
      out[count] = all[lane];
      count += lanes >> lane & 1;
    }
    return count;
  }
  static void
  storeTruncated(std::int32_t* out, Float a)
  {
    vst1q_s32(out, vcvtq_s32_f32(a));
  }
  /** \brief Groups come in ascending order, so the first clears the word. */
  static void
  store(Mask mask, std::uint64_t* words, std::size_t group)
  {
    const std::uint64_t lanes = static_cast<std::uint64_t>(bits(mask)) << (4 * group);
    *words = group == 0 ? lanes : *words | lanes;
  }
  static std::uint64_t
  commonBits(const std::uint64_t* a, const std::uint64_t* b, std::size_t words)
  {
    uint64x2_t sum = vdupq_n_u64(0);
    for (std::size_t w = 0; w < words; w += 2) {
      const uint64x2_t common = vandq_u64(vld1q_u64(a + w), vld1q_u64(b + w));
      const uint8x16_t bytes = vcntq_u8(vreinterpretq_u8_u64(common));
      sum = vpadalq_u32(sum, vpaddlq_u16(vpaddlq_u8(bytes)));
    }
    return vaddvq_u64(sum);
  }
};

} // namespace

extern const Kernels NEON_KERNELS;
constexpr Kernels NEON_KERNELS = simdKernels<Neon>("neon", &commonNeighboursSimd<Neon>);

} // namespace cpu
} // namespace pcl_flashreg
