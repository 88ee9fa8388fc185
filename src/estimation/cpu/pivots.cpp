// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 3: the K best edges, Eq. (pivot), by a histogram of the integer scores; ties go to
// the smaller u, then the smaller v.

#include "estimation/cpu/bits.h"
#include "estimation/cpu/stages.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Where the K best end: all scores above `threshold`, and the first `ties` of
 * those at it. */
struct Cut {
  std::uint32_t threshold;
  std::size_t ties;
};

/** \param[in] histogram number of candidates by score; score 0 does not count */
Cut
findCut(const std::vector<std::size_t>& histogram, std::size_t K)
{
  std::size_t above = 0;
  for (std::size_t score = histogram.size(); score-- > 1;) {
    if (above + histogram[score] >= K)
      return {static_cast<std::uint32_t>(score), K - above};
    above += histogram[score];
  }
  return {0, 0};
}

/** \brief Keeps (u, v, score) if it is among the K best; call in ascending (u, v). */
class Collector {
public:
  Collector(const Cut& cut, std::vector<Edge>& pivots) : cut_(cut), pivots_(pivots) {}

  void
  offer(std::uint32_t u, std::uint32_t v, std::uint32_t score)
  {
    if (score < cut_.threshold || score == 0)
      return;
    if (score == cut_.threshold) {
      if (cut_.ties == 0)
        return;
      --cut_.ties;
    }
    pivots_.push_back({u, v, score});
  }

private:
  Cut cut_;
  std::vector<Edge>& pivots_;
};

} // namespace

void
Stages::pivots()
{
  pivots_.clear();
  if (exact_)
    pivotsExact();
  else
    pivotsBounded();
  std::stable_sort(pivots_.begin(), pivots_.end(), [](const Edge& a, const Edge& b) {
    return a.score > b.score;
  });
}

void
Stages::pivotsExact()
{
  const std::uint32_t best =
      row_best_.empty() ? 0 : *std::max_element(row_best_.begin(), row_best_.end());
  std::vector<std::size_t> histogram(best + std::size_t{1}, 0);
  for (const std::uint32_t score : scores_)
    ++histogram[score];
  const Cut cut = findCut(histogram, parameters_->pivots);

  Collector collector(cut, pivots_);
  std::vector<std::uint32_t>& columns = scratch_[0].columns;
  for (std::uint32_t u = 0; u < size(); ++u) {
    if (row_best_[u] < cut.threshold || row_best_[u] == 0)
      continue;
    const std::size_t count = listBitsAbove(row(u), u, 0, words_, columns.data());
    const std::uint32_t* scores = scores_.data() + row_begin_[u];
    for (std::size_t i = 0; i < count; ++i)
      collector.offer(u, columns[i], scores[i]);
  }
}

void
Stages::pivotsBounded()
{
  const std::size_t m = parameters_->pool_capacity;
  std::vector<std::size_t> histogram(parameters_->row_capacity + std::size_t{1}, 0);
  for (std::size_t u = 0; u < size(); ++u)
    for (std::size_t i = 0; i < pool_length_[u]; ++i)
      ++histogram[pool_scores_[u * m + i]];

  // Within a pool, equal scores stand in ascending order of v: the ties come out right.
  Collector collector(findCut(histogram, parameters_->pivots), pivots_);
  for (std::uint32_t u = 0; u < size(); ++u)
    for (std::size_t i = 0; i < pool_length_[u]; ++i)
      collector.offer(u, pool_columns_[u * m + i], pool_scores_[u * m + i]);
}

} // namespace cpu
} // namespace pcl_flashreg
