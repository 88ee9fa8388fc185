// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 2: every edge of the first-order graph is scored by the neighbours that its ends
// share; exactly, Eq. (sog), or within fixed capacities, Eq. (sog_trunc) and (ell_sog).

#include "estimation/cpu/bits.h"
#include "estimation/cpu/stages.h"

#include <algorithm>
#include <numeric>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Rows that are scored together against a band of columns, and words in a band:
 * both should stay in the second-level cache while they are matched. */
constexpr std::size_t MOST_ROWS_A_TASK = 512;
constexpr std::size_t BAND_WORDS = 64 * 1024;

} // namespace

/** \brief Rows are dealt out in blocks: large ones for the cache's sake, but several for
 * every thread. */
std::size_t
Stages::rowsATask() const
{
  return std::clamp<std::size_t>(size() / (6 * pool_.size()), 16, MOST_ROWS_A_TASK);
}

void
Stages::countDegrees()
{
  const std::size_t rows = rowsATask();
  degrees_.resize(size());
  const std::size_t tasks = (size() + rows - 1) / rows;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t) {
    const std::size_t end = std::min(size(), (task + 1) * rows);
    for (std::size_t i = task * rows; i < end; ++i)
      degrees_[i] = static_cast<std::uint32_t>(kernels_.countBits(row(i), words_));
  });
}

/** \brief Neighbours of i with larger indices. */
std::size_t
Stages::countNeighboursAbove(std::size_t i) const
{
  const std::size_t word = i / WORD_BITS;
  const std::uint64_t first = row(i)[word] & bitsAbove(i % WORD_BITS);
  return kernels_.countBits(&first, 1) +
         kernels_.countBits(row(i) + word + 1, words_ - word - 1);
}

void
Stages::secondOrderGraph()
{
  countDegrees();
  const std::uint64_t degree_sum =
      std::accumulate(degrees_.begin(), degrees_.end(), std::uint64_t{0});
  switch (parameters_->second_order) {
  case SecondOrder::Exact:
    exact_ = true;
    break;
  case SecondOrder::Bounded:
    exact_ = false;
    break;
  case SecondOrder::Auto:
    exact_ = degree_sum <= std::uint64_t{8} * parameters_->row_capacity * size();
    break;
  }
  for (Scratch& scratch : scratch_) {
    scratch.voters.resize(words_);
    scratch.columns.resize(size());
    scratch.ranks_u.resize(size());
    scratch.ranks_v.resize(size());
  }
  if (exact_)
    scoreExactly();
  else
    scoreBounded();
}

void
Stages::scoreExactly()
{
  const std::size_t n = size();
  row_begin_.resize(n + 1);
  row_begin_[0] = 0;
  for (std::size_t i = 0; i < n; ++i)
    row_begin_[i + 1] = row_begin_[i] + countNeighboursAbove(i);
  scores_.resize(row_begin_[n]);
  row_best_.assign(n, 0);

  // Columns of a band, in words of a row.
  const std::size_t band_words =
      std::max<std::size_t>(1, BAND_WORDS / words_ / WORD_BITS);
  const std::size_t rows = rowsATask();
  const std::size_t tasks = (n + rows - 1) / rows;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t thread) {
    const std::size_t begin = task * rows;
    const std::size_t end = std::min(n, begin + rows);
    std::uint32_t* columns = scratch_[thread].columns.data();
    std::size_t next[MOST_ROWS_A_TASK];
    std::copy(row_begin_.begin() + begin, row_begin_.begin() + end, next);
    for (std::size_t band = begin / WORD_BITS; band < words_; band += band_words)
      for (std::size_t u = begin; u < end; ++u) {
        const std::size_t count = listBitsAbove(row(u),
                                                static_cast<std::uint32_t>(u),
                                                band,
                                                std::min(words_, band + band_words),
                                                columns);
        std::uint32_t* scores = scores_.data() + next[u - begin];
        kernels_.commonNeighbours(
            row(u), graph_.data(), words_, words_, columns, count, scores);
        next[u - begin] += count;
        if (count != 0)
          row_best_[u] =
              std::max(row_best_[u], *std::max_element(scores, scores + count));
      }
  });
}

/** \brief One row of the ELLPACK-R layout and its candidate pool. */
void
Stages::scoreRowBounded(std::size_t u, std::size_t thread)
{
  const std::size_t L = parameters_->row_capacity, m = parameters_->pool_capacity;
  Scratch& scratch = scratch_[thread];
  // The voters are the L neighbours with the smallest indices.
  const std::uint64_t* voters = row(u);
  std::size_t voter_words = words_;
  if (degrees_[u] > L) {
    voter_words = copyFirstBits(row(u), L, scratch.voters.data());
    voters = scratch.voters.data();
  }
  std::uint32_t* ell_columns = ell_columns_.data() + u * L;
  std::uint32_t* ell_scores = ell_scores_.data() + u * L;
  std::size_t length = 0;
  for (std::size_t word = u / WORD_BITS; word < words_ && length < L; ++word) {
    std::uint32_t columns[WORD_BITS], scores[WORD_BITS];
    const std::size_t count =
        listBitsAbove(row(u), static_cast<std::uint32_t>(u), word, word + 1, columns);
    kernels_.commonNeighbours(
        voters, graph_.data(), words_, voter_words, columns, count, scores);
    for (std::size_t i = 0; i < count && length < L; ++i)
      if (scores[i] > 0) {
        ell_columns[length] = columns[i];
        ell_scores[length++] = scores[i];
      }
  }
  ell_length_[u] = static_cast<std::uint32_t>(length);

  std::uint32_t* order = scratch.columns.data();
  std::iota(order, order + length, 0u);
  const std::size_t pooled = std::min(m, length);
  std::partial_sort(
      order, order + pooled, order + length, [&](std::uint32_t a, std::uint32_t b) {
        return ell_scores[a] != ell_scores[b] ? ell_scores[a] > ell_scores[b] : a < b;
      });
  for (std::size_t i = 0; i < pooled; ++i) {
    pool_columns_[u * m + i] = ell_columns[order[i]];
    pool_scores_[u * m + i] = ell_scores[order[i]];
  }
  pool_length_[u] = static_cast<std::uint32_t>(pooled);
}

void
Stages::scoreBounded()
{
  const std::size_t n = size();
  const std::size_t L = parameters_->row_capacity, m = parameters_->pool_capacity;
  ell_columns_.resize(n * L);
  ell_scores_.resize(n * L);
  ell_length_.resize(n);
  pool_columns_.resize(n * m);
  pool_scores_.resize(n * m);
  pool_length_.resize(n);
  const std::size_t rows = rowsATask();
  const std::size_t tasks = (n + rows - 1) / rows;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t thread) {
    const std::size_t end = std::min(n, (task + 1) * rows);
    for (std::size_t u = task * rows; u < end; ++u)
      scoreRowBounded(u, thread);
  });
}

} // namespace cpu
} // namespace pcl_flashreg
