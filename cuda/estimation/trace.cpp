// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Copies what the stages left on the device to the host: the hypotheses for those who judge
// them otherwise, all of it for tests and diagnostics.

#include "cuda/estimation/stages.h"

#include <cstring>

namespace pcl_flashreg {
namespace cuda {

template <typename T>
std::vector<T>
Stages::download(const T* from, std::size_t n) const
{
  std::vector<T> values(n);
  if (n == 0)
    return values;
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(
      values.data(), from, n * sizeof(T), cudaMemcpyDeviceToHost, stream_.get()));
  stream_.synchronize();
  return values;
}

/** \param[in] entries how many the rows have room for, all in all */
void
Stages::traceRows(const Rows& rows, std::size_t entries, std::vector<Edge>& edges) const
{
  const std::vector<Row> ranges = download(rows.rows, call_.size);
  const std::vector<unsigned> columns = download(rows.columns, entries);
  const std::vector<unsigned> scores =
      download(rows.scores, call_.exact ? entries / 2 : entries);
  for (unsigned u = 0; u < call_.size; ++u)
    for (unsigned i = 0; i < ranges[u].length; ++i) {
      const Edge edge{
          u, columns[ranges[u].columns_begin + i], scores[ranges[u].scores_begin + i]};
      if (edge.score > 0)
        edges.push_back(edge);
    }
}

void
Stages::traceBits(Trace& trace) const
{
  trace.first_order_graph.resize(trace.size * trace.words_per_row);
  const std::vector<unsigned> words = download(call_.graph, trace.size * call_.words);
  if (!words.empty())
    std::memcpy(
        trace.first_order_graph.data(), words.data(), words.size() * sizeof(unsigned));
}

void
Stages::traceHypotheses(Trace& trace) const
{
  const std::size_t pivots = control().pivots, T = call_.cliques_per_pivot;
  for (const unsigned long long key : download(call_.pivot_keys, pivots))
    trace.pivots.push_back(Pivot::edge(key));
  const std::vector<unsigned> counts = download(call_.clique_counts, pivots);
  const std::vector<Clique> cliques = download(call_.cliques, pivots * T);
  const std::vector<Pose> poses = download(call_.poses, call_.slots);
  const std::vector<long long> scores = download(call_.scores, call_.slots);
  const auto addSlot = [&](std::size_t slot) {
    trace.hypotheses.push_back(poses[slot]);
    trace.hypothesis_valid.push_back(scores[slot] >= 0);
    trace.scores.push_back(scores[slot]);
  };
  for (std::size_t p = 0; p < pivots; ++p)
    for (std::size_t t = 0; t < counts[p]; ++t) {
      trace.cliques.push_back(cliques[p * T + t]);
      addSlot(p * T + t);
    }
  if (call_.has_guess)
    addSlot(call_.slots - 1);
}

std::vector<Pose>
Stages::candidates() const
{
  const std::size_t pivots = control().pivots, T = call_.cliques_per_pivot;
  const std::vector<unsigned> counts = download(call_.clique_counts, pivots);
  const std::vector<Pose> poses = download(call_.poses, call_.slots);
  const std::vector<long long> scores = download(call_.scores, call_.slots);
  std::vector<Pose> valid;
  const auto addSlot = [&](std::size_t slot) {
    if (scores[slot] >= 0)
      valid.push_back(poses[slot]);
  };
  for (std::size_t p = 0; p < pivots; ++p)
    for (std::size_t t = 0; t < counts[p]; ++t)
      addSlot(p * T + t);
  if (call_.has_guess)
    addSlot(call_.slots - 1);
  return valid;
}

void
Stages::copyTo(Trace& trace) const
{
  const std::size_t n = call_.size;
  trace = Trace{};
  trace.size = n;
  trace.words_per_row = call_.padded / WORD_BITS;
  if (options_.bits)
    traceBits(trace);
  if (options_.lists)
    traceRows(call_.upper,
              call_.exact ? control().entries : n * call_.row_capacity,
              trace.second_order_graph);
  if (options_.lists && !call_.exact)
    traceRows(call_.pool, n * call_.pool_capacity, trace.pools);
  traceHypotheses(trace);
}

} // namespace cuda
} // namespace pcl_flashreg
