// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "simd/kernels.h"

#include <pcl_flashreg/estimator.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace cpu {

extern const Kernels SCALAR_KERNELS;
#if defined(PCL_FLASHREG_X86)
extern const Kernels AVX2_KERNELS;
extern const Kernels AVX512_KERNELS;
#elif defined(PCL_FLASHREG_AARCH64)
extern const Kernels NEON_KERNELS;
#endif

namespace {

constexpr const char* VARIABLE = "PCL_FLASHREG_CPU";
constexpr const char* KNOWN_NAMES[] = {"scalar", "avx2", "avx512", "neon"};

struct Available {
  const Kernels* table[4];
  std::size_t count = 0;

  Available()
  {
#if defined(PCL_FLASHREG_X86)
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512vpopcntdq"))
      table[count++] = &AVX512_KERNELS;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
        __builtin_cpu_supports("popcnt"))
      table[count++] = &AVX2_KERNELS;
#elif defined(PCL_FLASHREG_AARCH64)
    table[count++] = &NEON_KERNELS;
#endif
    table[count++] = &SCALAR_KERNELS;
  }
};

} // namespace

const Kernels* const*
availableKernels(std::size_t& count)
{
  static const Available available;
  count = available.count;
  return available.table;
}

const Kernels&
scalarKernels()
{
  return SCALAR_KERNELS;
}

const Kernels&
selectKernels()
{
  std::size_t count = 0;
  const Kernels* const* available = availableKernels(count);
  const char* wanted = std::getenv(VARIABLE);
  if (!wanted || !*wanted || std::string("auto") == wanted)
    return *available[0];
  for (std::size_t i = 0; i < count; ++i)
    if (std::string(available[i]->name) == wanted)
      return *available[i];
  for (const char* name : KNOWN_NAMES)
    if (std::string(name) == wanted)
      throw BackendError(std::string(VARIABLE) + "=" + wanted +
                         ": this processor or this build does not have it");
  throw std::invalid_argument(std::string(VARIABLE) + "=" + wanted +
                              ": unknown; known are auto, scalar, avx2, avx512, neon");
}

const Kernels&
usualKernels()
{
  static const Kernels& chosen = selectKernels();
  return chosen;
}

} // namespace cpu
} // namespace pcl_flashreg
