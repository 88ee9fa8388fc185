// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "work.h"

#include "estimation/problem.h"
#include "estimation/trace.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_flashreg::benchmark {
namespace {

// The least that a test can do, all of them operations on single-precision numbers.
/** \brief Two squared lengths, five each with the points' norms at hand; their sum, their
 * difference, and the two products that tell its sign from τ; two comparisons. */
constexpr double OPERATIONS_A_PAIR = 16;
/** \brief Three components of four operations, their squares, a comparison, a count. */
constexpr double OPERATIONS_A_RESIDUAL = 17;

/** \brief Bytes that scoring every edge reads at least: of the shorter of v's list and v's
 * row of bits, which is how the kernel chooses, too. */
double
leastScoreBytes(const Trace& trace, std::size_t words)
{
  std::vector<std::size_t> degree(trace.size, 0);
  for (std::size_t u = 0; u < trace.size; ++u)
    for (std::size_t w = 0; w < trace.words_per_row; ++w)
      degree[u] += static_cast<std::size_t>(
          __builtin_popcountll(trace.first_order_graph[u * trace.words_per_row + w]));
  double bytes = 0;
  for (std::size_t u = 0; u < trace.size; ++u)
    for (std::size_t v = u + 1; v < trace.size; ++v)
      if (trace.hasEdge(u, v))
        bytes += 4.0 * static_cast<double>(std::min(degree[v], words));
  return bytes;
}

} // namespace

Work
workOf(const Problem& problem, const Trace& trace, bool exact)
{
  const auto n = static_cast<double>(problem.size);
  Work work;
  work.first_order_graph_operations = n * n / 2 * OPERATIONS_A_PAIR;
  work.verification_operations =
      n * static_cast<double>(trace.hypotheses.size()) * OPERATIONS_A_RESIDUAL;
  if (exact)
    work.second_order_graph_bytes = leastScoreBytes(trace, (problem.size + 31) / 32);
  return work;
}

Floor
floorOf(const Work& work, const Ceilings& ceilings)
{
  const double operations = 1e-3 * ceilings.operations_per_second;
  const double bytes = 1e-3 * ceilings.cache_bytes_per_second;
  Floor floor;
  floor.first_order_graph = work.first_order_graph_operations / operations;
  floor.verification = work.verification_operations / operations;
  if (work.second_order_graph_bytes)
    floor.second_order_graph = *work.second_order_graph_bytes / bytes;
  return floor;
}

} // namespace pcl_flashreg::benchmark
