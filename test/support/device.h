// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// For tests that run on a device and on the emulated one.

#include "estimation/backend.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

#if defined(PCL_FLASHREG_EMULATED)
#include "emulation.h"
#endif

/** \brief Skips the test where there is no device; the emulation always has one. */
#define PCL_FLASHREG_NEEDS_DEVICE                                                      \
  try {                                                                                \
    ::pcl_flashreg::makeCudaBackend();                                                 \
  }                                                                                    \
  catch (const ::pcl_flashreg::BackendError& error) {                                  \
    GTEST_SKIP() << error.what();                                                      \
  }

namespace pcl_flashreg {

/** \brief A device without errors whose threads run in an order, see
 * cuda_emulation::Order; a real one has its own. */
inline void
freshDevice([[maybe_unused]] int order = 0, [[maybe_unused]] unsigned seed = 0)
{
#if defined(PCL_FLASHREG_EMULATED)
  cuda_emulation::reset();
  cuda_emulation::device().order = static_cast<cuda_emulation::Order>(order);
  cuda_emulation::device().seed = seed;
#endif
}

} // namespace pcl_flashreg
