// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Entry point for libFuzzer; the target is chosen when this file is compiled.

#include "targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pcl_flashreg::fuzz::PCL_FLASHREG_FUZZ_TARGET(
      {reinterpret_cast<const char*>(data), size});
  return 0;
}
