// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

namespace pcl_flashreg::benchmark {

/** \brief What this device can do, by measurement. */
struct Ceilings {
  /** \brief Single-precision operations, a fused one counted once. */
  double operations_per_second = 0;
  /** \brief Reads of 16 bytes a thread from a buffer that the second-level cache holds. */
  double cache_bytes_per_second = 0;
};

/** \throws BackendError */
Ceilings
measureCeilings();

} // namespace pcl_flashreg::benchmark
