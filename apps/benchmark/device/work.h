// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "ceilings.h"

#include <optional>

namespace pcl_flashreg {

struct Problem;
struct Trace;

namespace benchmark {

/** \brief What three stages must at least do on a problem. The other stages are chains of
 * dependent steps on few data: no ceiling of throughput bounds them. */
struct Work {
  double first_order_graph_operations = 0, verification_operations = 0;
  /** \brief Read by the exact form; nothing is counted of the bounded one. */
  std::optional<double> second_order_graph_bytes;
};

/** \param[in] trace of this problem */
Work
workOf(const Problem& problem, const Trace& trace, bool exact);

/** \brief How long that takes at the ceilings, ms. */
struct Floor {
  double first_order_graph = 0, verification = 0;
  std::optional<double> second_order_graph;

  double
  total() const
  {
    return first_order_graph + second_order_graph.value_or(0) + verification;
  }
};

Floor
floorOf(const Work& work, const Ceilings& ceilings);

} // namespace benchmark
} // namespace pcl_flashreg
