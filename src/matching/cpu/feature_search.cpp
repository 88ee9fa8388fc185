// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Queries descend the targets' tree in groups, and leave out what their shadows show to be
// too far. In the blocks that they reach, inner products in single precision rule out
// nearly every pair; what could be among the k best is measured in double precision, so
// that the result is that of an exhaustive search in double precision. All of this among
// descriptors that differ; match_table.cpp has the others.

#include "matching/cpu/feature_search.h"

#include "simd/kernels.h"
#include "matching/cpu/match_table.h"
#include "matching/cpu/nearest_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_flashreg {
namespace {

using cpu::FEATURE_BLOCK;
using cpu::QUERY_BLOCK;

/** \brief Groups of queries in a task. */
constexpr std::size_t GROUPS_A_TASK = 8;
/** \brief Covers what underflows in single precision: squares of values near zero. */
constexpr double UNDERFLOW_ERROR = std::numeric_limits<float>::min();

double
squaredDistance(const float* a, const float* b, std::size_t n)
{
  // Four sums side by side, so that an addition need not wait for the one before.
  constexpr std::size_t LANES = 4;
  double sums[LANES] = {};
  const auto add = [&](std::size_t lane, std::size_t d) {
    const double difference = static_cast<double>(a[d]) - b[d];
    sums[lane] += difference * difference;
  };
  std::size_t d = 0;
  for (; d + LANES <= n; d += LANES)
    for (std::size_t lane = 0; lane < LANES; ++lane)
      add(lane, d + lane);
  for (; d < n; ++d)
    add(d % LANES, d);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/** \brief Finds the matches of QUERY_BLOCK queries at a time. One object a thread. */
class GroupSearch {
public:
  GroupSearch(const FeatureSet& queries,
              const FeatureSet& targets,
              const TargetBlocks& blocks,
              const FeatureSpace& space,
              std::size_t k,
              const cpu::Kernels& kernels)
      : queries_(queries),
        targets_(targets),
        blocks_(blocks),
        space_(space),
        kernels_(kernels),
        slack_(space.slack()),
        values_(QUERY_BLOCK * space.dimension()),
        lists_(QUERY_BLOCK, k)
  {
  }

  /** \brief Searches for queries [first, last) of the tree's order, QUERY_BLOCK at most;
   * list q of the result is that of query first + q. */
  const NearestLists&
  run(std::size_t first, std::size_t last)
  {
    begin(first, last);
    descend(0, 0, targets_.tree.blocks());
    return lists_;
  }

private:
  /** \brief A query; lengths and distances are those of centred and scaled values. */
  struct Query {
    const float* descriptor;
    double squared_norm;
    /** \brief By rounding, a squared distance of the filter may be this much larger than
     * it is, and a distance of shadows. */
    double filter_error, shadow_error;
    /** \brief Squared distance of shadows beyond which there is no match. */
    float reach;
  };

  void
  begin(std::size_t first, std::size_t last)
  {
    seeds_.clear();
    for (std::size_t q = 0; q < count_; ++q)
      for (const Candidate* match = lists_.begin(q); match != lists_.end(q); ++match)
        seeds_.push_back(match->index);
    std::sort(seeds_.begin(), seeds_.end());
    seeds_.erase(std::unique(seeds_.begin(), seeds_.end()), seeds_.end());

    count_ = last - first;
    box_ = queries_.tree.bounds(first, last);
    std::fill(thresholds_,
              thresholds_ + QUERY_BLOCK,
              -std::numeric_limits<float>::infinity());
    // The groups follow each other through the tree: what matched the last is a good first
    // guess, and spares many an offer.
    for (std::size_t q = 0; q < count_; ++q) {
      take(q, static_cast<std::size_t>(queries_.tree.order[first + q]));
      for (const std::int32_t seed : seeds_)
        offer(q, seed);
    }
    updateReach();
  }

  void
  take(std::size_t q, std::size_t index)
  {
    Query& query = group_[q];
    query.descriptor = queries_.features[index];
    float* values = values_.data() + q * space_.dimension();
    space_.centre(query.descriptor, values);
    query.squared_norm = squaredNorm(values, space_.dimension());
    // The filter computes |t|^2 - 2 q.t. A sum of n products errs by at most n u |q| |t|, in
    // any order of summation; the bound covers the other roundings, too.
    const double lengths = std::sqrt(query.squared_norm) + blocks_.longest();
    query.filter_error =
        (static_cast<double>(space_.dimension()) + 8) / (1 << 23) * lengths * lengths +
        UNDERFLOW_ERROR;
    query.shadow_error = slack_ * lengths;
    query.reach = thresholds_[q] = std::numeric_limits<float>::max();
    lists_.clear(q);
  }

  void
  descend(std::size_t node, std::size_t begin, std::size_t end)
  {
    if (end - begin == 1) {
      scan(begin);
      return;
    }
    const std::size_t middle = FeatureTree::middle(begin, end);
    const std::size_t left = node + 1;
    const std::size_t right = FeatureTree::rightChild(node, begin, end);
    const float to_left = box_.squaredDistance(targets_.tree.boxes[left]);
    const float to_right = box_.squaredDistance(targets_.tree.boxes[right]);
    // The nearer one first: what it holds may rule out the other.
    const bool right_first = to_right < to_left;
    if (right_first && to_right <= reach_)
      descend(right, middle, end);
    if (to_left <= reach_)
      descend(left, begin, middle);
    if (!right_first && to_right <= reach_)
      descend(right, middle, end);
  }

  void
  scan(std::size_t block)
  {
    std::uint32_t candidates[QUERY_BLOCK];
    kernels_.featureCandidates(
        blocks_.input(), block, {values_.data(), thresholds_}, candidates);
    bool better = false;
    for (std::size_t q = 0; q < count_; ++q)
      for (std::uint32_t bits = candidates[q]; bits != 0; bits &= bits - 1)
        better |=
            offer(q, targets_.tree.order[block * FEATURE_BLOCK + __builtin_ctz(bits)]);
    if (better)
      updateReach();
  }

  /** \return whether the query has less far to look now */
  bool
  offer(std::size_t q, std::int32_t target)
  {
    Query& query = group_[q];
    const double distance =
        squaredDistance(query.descriptor,
                        targets_.features[static_cast<std::size_t>(target)],
                        space_.dimension());
    if (!lists_.offer(q, {distance, target}) ||
        lists_.worst(q) == std::numeric_limits<double>::infinity())
      return false;
    const double worst = lists_.worst(q) * space_.scale() * space_.scale();
    thresholds_[q] =
        static_cast<float>(worst - query.squared_norm + query.filter_error);
    const double reach = std::sqrt(worst) + query.shadow_error;
    // Boxes are told apart in single precision.
    query.reach = static_cast<float>(reach * reach * (1 + 1e-6) + UNDERFLOW_ERROR);
    return true;
  }

  void
  updateReach()
  {
    reach_ = 0;
    for (std::size_t q = 0; q < count_; ++q)
      reach_ = std::max(reach_, group_[q].reach);
  }

  const FeatureSet& queries_;
  const FeatureSet& targets_;
  const TargetBlocks& blocks_;
  const FeatureSpace& space_;
  const cpu::Kernels& kernels_;
  const double slack_;
  std::vector<float> values_;
  NearestLists lists_;
  std::vector<std::int32_t> seeds_;
  std::size_t count_ = 0;
  ShadowBox box_;
  float reach_ = 0;
  Query group_[QUERY_BLOCK] = {};
  float thresholds_[QUERY_BLOCK] = {};
};

} // namespace

std::vector<FeatureMatch>
searchNearest(const FeatureSet& queries,
              const FeatureSet& targets,
              const TargetBlocks& blocks,
              const FeatureSpace& space,
              std::size_t k,
              ThreadPool& pool)
{
  const cpu::Kernels& kernels = cpu::selectKernels();
  const std::size_t size = queries.features.size();
  const std::size_t nearest = std::min(k, targets.features.size());
  MatchTable matches(queries.features, targets.features, k);
  constexpr std::size_t TASK = GROUPS_A_TASK * QUERY_BLOCK;
  std::vector<std::optional<GroupSearch>> searches(pool.size());
  pool.forEach((size + TASK - 1) / TASK, [&](std::size_t task, std::size_t thread) {
    std::optional<GroupSearch>& search = searches[thread];
    if (!search)
      search.emplace(queries, targets, blocks, space, nearest, kernels);
    const std::size_t end = std::min(size, (task + 1) * TASK);
    for (std::size_t first = task * TASK; first < end; first += QUERY_BLOCK) {
      const std::size_t last = std::min(end, first + QUERY_BLOCK);
      const NearestLists& lists = search->run(first, last);
      for (std::size_t i = first; i < last; ++i)
        matches.enter(static_cast<std::size_t>(queries.tree.order[i]),
                      lists.begin(i - first),
                      lists.end(i - first));
    }
  });
  return matches.take();
}

} // namespace pcl_flashreg
