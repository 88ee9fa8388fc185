// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 4: the T best third vertices of every pivot, Eq. (common) and (clique); ties go to
// the smaller vertex.

#include "estimation/cpu/bits.h"
#include "estimation/cpu/stages.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {
namespace {

constexpr std::size_t PIVOTS_A_TASK = 64;

/** \brief The best T of the cliques offered in ascending w, best first. */
class BestCliques {
public:
  BestCliques(Clique* slots, std::size_t capacity) : slots_(slots), capacity_(capacity)
  {
  }

  void
  offer(const Clique& clique)
  {
    if (count_ == capacity_ && clique.score <= slots_[count_ - 1].score)
      return;
    std::size_t at = count_ < capacity_ ? count_++ : count_ - 1;
    for (; at > 0 && slots_[at - 1].score < clique.score; --at)
      slots_[at] = slots_[at - 1];
    slots_[at] = clique;
  }

  std::size_t
  count() const
  {
    return count_;
  }

private:
  Clique* slots_;
  std::size_t capacity_;
  std::size_t count_ = 0;
};

} // namespace

/** \brief An edge's place among its row's scores is the number of bits before it. */
std::size_t
Stages::cliquesExact(const Edge& pivot, std::size_t thread, Clique* best)
{
  const std::size_t first = pivot.v / WORD_BITS;
  const std::uint64_t above_v = bitsAbove(pivot.v % WORD_BITS);
  Scratch& scratch = scratch_[thread];
  const std::size_t count = kernels_.intersect(row(pivot.u),
                                               row(pivot.v),
                                               first,
                                               words_,
                                               above_v,
                                               scratch.columns.data(),
                                               scratch.ranks_u.data(),
                                               scratch.ranks_v.data());
  // Scores of u end with those above v.
  const std::uint64_t masked = row(pivot.u)[first] & above_v;
  const std::size_t u_above_v =
      kernels_.countBits(&masked, 1) +
      kernels_.countBits(row(pivot.u) + first + 1, words_ - first - 1);
  const std::uint32_t* scores_u = scores_.data() + row_begin_[pivot.u + 1] - u_above_v;
  const std::uint32_t* scores_v = scores_.data() + row_begin_[pivot.v];

  BestCliques cliques(best, parameters_->cliques_per_pivot);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t score_u = scores_u[scratch.ranks_u[i]];
    const std::uint32_t score_v = scores_v[scratch.ranks_v[i]];
    if (score_u > 0 && score_v > 0)
      cliques.offer(
          {pivot.u, pivot.v, scratch.columns[i], pivot.score + score_u + score_v});
  }
  return cliques.count();
}

/** \brief Merges two rows of the ELLPACK-R layout. */
std::size_t
Stages::cliquesBounded(const Edge& pivot, Clique* best) const
{
  const std::size_t L = parameters_->row_capacity;
  const std::uint32_t* columns_u = ell_columns_.data() + pivot.u * L;
  const std::uint32_t* columns_v = ell_columns_.data() + pivot.v * L;
  BestCliques cliques(best, parameters_->cliques_per_pivot);
  for (std::size_t a = 0, b = 0;
       a < ell_length_[pivot.u] && b < ell_length_[pivot.v];) {
    if (columns_u[a] < columns_v[b])
      ++a;
    else if (columns_u[a] > columns_v[b])
      ++b;
    else {
      cliques.offer(
          {pivot.u,
           pivot.v,
           columns_u[a],
           pivot.score + ell_scores_[pivot.u * L + a] + ell_scores_[pivot.v * L + b]});
      ++a;
      ++b;
    }
  }
  return cliques.count();
}

void
Stages::cliques()
{
  const std::size_t T = parameters_->cliques_per_pivot;
  clique_slots_.resize(pivots_.size() * T);
  clique_counts_.resize(pivots_.size());
  const std::size_t tasks = (pivots_.size() + PIVOTS_A_TASK - 1) / PIVOTS_A_TASK;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t thread) {
    const std::size_t end = std::min(pivots_.size(), (task + 1) * PIVOTS_A_TASK);
    for (std::size_t p = task * PIVOTS_A_TASK; p < end; ++p) {
      Clique* slots = clique_slots_.data() + p * T;
      clique_counts_[p] =
          static_cast<std::uint32_t>(exact_ ? cliquesExact(pivots_[p], thread, slots)
                                            : cliquesBounded(pivots_[p], slots));
    }
  });
  cliques_.clear();
  for (std::size_t p = 0; p < pivots_.size(); ++p)
    cliques_.insert(cliques_.end(),
                    clique_slots_.begin() + p * T,
                    clique_slots_.begin() + p * T + clique_counts_[p]);
}

} // namespace cpu
} // namespace pcl_flashreg
