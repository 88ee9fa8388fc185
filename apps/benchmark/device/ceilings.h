// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_flashreg {

struct Parameters;
struct Problem;
struct Trace;

namespace benchmark {

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

/** \brief What three stages must at least do on a problem, and the time that takes at the
 * ceilings. The other stages are chains of dependent steps on few data: no ceiling of
 * throughput bounds them. */
struct Floor {
  double first_order_graph_ms = 0, verification_ms = 0;
  /** \brief Of the exact form. */
  std::optional<double> second_order_graph_ms;

  double
  total() const
  {
    return first_order_graph_ms + second_order_graph_ms.value_or(0) + verification_ms;
  }
};

/** \param[in] trace of this problem */
Floor
floorOf(const Problem& problem,
        const Trace& trace,
        bool exact,
        const Ceilings& ceilings);

} // namespace benchmark
} // namespace pcl_flashreg
