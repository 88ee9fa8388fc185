// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Exhaustive nearest neighbours in feature space. Inner products in single precision rule
// out nearly every pair; what could be among the k best is measured in double precision,
// so that the result is that of an exhaustive search in double precision.

#include <pcl_flashreg/feature_matching.h>

#include "aligned_buffer.h"
#include "cpu/kernels/kernels.h"
#include "cpu/thread_pool.h"
#include "nearest_lists.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace pcl_flashreg {
namespace {

using cpu::FEATURE_BLOCK;
using cpu::QUERY_BLOCK;

/** \brief Blocks of queries in a task. */
constexpr std::size_t BLOCKS_A_TASK = 8;

const float*
descriptor(const FeatureView& view, std::size_t i)
{
  return view.data + i * view.stride;
}

bool
allFinite(const float* values, std::size_t n)
{
  return std::all_of(values, values + n, [](float x) { return std::isfinite(x); });
}

double
squaredNorm(const float* values, std::size_t n)
{
  double sum = 0;
  for (std::size_t d = 0; d < n; ++d)
    sum += static_cast<double>(values[d]) * values[d];
  return sum;
}

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

void
check(const char* name, const FeatureView& view)
{
  if (view.size > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument(std::string(name) + ": size " +
                                std::to_string(view.size) +
                                " is out of range: it must fit 31 bits");
  if (view.size > 0 &&
      (!view.data || view.dimension == 0 || view.stride < view.dimension))
    throw std::invalid_argument(
        std::string(name) +
        ": needs data, a dimension >= 1 and a stride >= it; got "
        "dimension " +
        std::to_string(view.dimension) + ", stride " + std::to_string(view.stride));
}

/** \brief The targets, transposed in blocks, with their norms. */
struct TargetBlocks {
  AlignedBuffer<float> values, norms;
  std::size_t count = 0;
  double largest_norm = 0;

  explicit TargetBlocks(const FeatureView& targets)
      : count((targets.size + FEATURE_BLOCK - 1) / FEATURE_BLOCK)
  {
    const std::size_t dimension = targets.dimension;
    values.resize(count * dimension * FEATURE_BLOCK);
    norms.resize(count * FEATURE_BLOCK);
    std::fill(values.begin(), values.end(), 0.0f);
    std::fill(norms.begin(), norms.end(), std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < targets.size; ++i) {
      const float* target = descriptor(targets, i);
      if (!allFinite(target, dimension))
        continue;
      const double norm = squaredNorm(target, dimension);
      largest_norm = std::max(largest_norm, norm);
      norms[i] = static_cast<float>(norm);
      const std::size_t block = i / FEATURE_BLOCK, lane = i % FEATURE_BLOCK;
      for (std::size_t d = 0; d < dimension; ++d)
        values[(block * dimension + d) * FEATURE_BLOCK + lane] = target[d];
    }
  }
};

/** \brief Rounding may make a squared distance of the filter, |q|^2 + |t|^2 - 2 q.t, this
 * much larger than it is: a sum of n products errs by at most n u |q| |t|, in any order of
 * summation; the bound covers the other roundings, too. */
double
filterError(double query_norm, double target_norm, std::size_t dimension)
{
  const double reach = std::sqrt(query_norm) + std::sqrt(target_norm);
  return (static_cast<double>(dimension) + 8) / (1 << 23) * reach * reach;
}

/** \brief Finds the matches of QUERY_BLOCK queries at a time, and with `both_ways`, of the
 * targets among them. One object a thread. */
class BlockSearch {
public:
  BlockSearch(const FeatureView& queries,
              const FeatureView& targets,
              const TargetBlocks& blocks,
              double largest_query_norm,
              std::size_t k,
              bool both_ways,
              const cpu::Kernels& kernels)
      : queries_(queries),
        targets_(targets),
        blocks_(blocks),
        kernels_(kernels),
        both_ways_(both_ways),
        limit_error_(
            filterError(largest_query_norm, blocks.largest_norm, queries.dimension)),
        packed_(QUERY_BLOCK * queries.dimension),
        forward_(QUERY_BLOCK, k),
        backward_(both_ways ? targets.size : 0, k)
  {
    limits_.resize(blocks.count * FEATURE_BLOCK);
    const float none = std::numeric_limits<float>::infinity();
    std::fill(limits_.begin(), limits_.end(), -none);
    for (std::size_t t = 0; both_ways && t < targets.size; ++t)
      if (blocks.norms[t] < none)
        limits_[t] = std::numeric_limits<float>::max();
  }

  /** \brief Searches for the queries from `first` on; list q of the result is that of
   * query first + q. */
  const NearestLists&
  run(std::size_t first)
  {
    begin(first);
    const cpu::FeatureBlock input{blocks_.values.data(),
                                  blocks_.norms.data(),
                                  limits_.data(),
                                  targets_.dimension};
    const cpu::QueryRows rows{packed_.data(), float_norms_, thresholds_};
    for (std::size_t block = 0; block < blocks_.count; ++block) {
      std::uint32_t candidates[QUERY_BLOCK];
      kernels_.featureCandidates(input, block, rows, candidates);
      for (std::size_t q = 0; q < QUERY_BLOCK; ++q)
        for (std::uint32_t bits = candidates[q]; bits != 0; bits &= bits - 1)
          offer(first, q, block * FEATURE_BLOCK + __builtin_ctz(bits), both_ways_);
    }
    return forward_;
  }

  /** \brief The matches of the targets among the queries that were searched for. */
  const NearestLists&
  backward() const
  {
    return backward_;
  }

private:
  void
  begin(std::size_t first)
  {
    const std::size_t dimension = queries_.dimension;
    std::fill(packed_.begin(), packed_.end(), 0.0f);
    seeds_.clear();
    for (std::size_t q = 0; q < QUERY_BLOCK; ++q) {
      for (const Candidate* match = forward_.begin(q); match != forward_.end(q);
           ++match)
        seeds_.push_back(match->index);
      forward_.clear(q);
      thresholds_[q] = -std::numeric_limits<float>::infinity();
      float_norms_[q] = std::numeric_limits<float>::infinity();
      if (first + q >= queries_.size)
        continue;
      const float* query = descriptor(queries_, first + q);
      if (!allFinite(query, dimension))
        continue;
      std::copy(query, query + dimension, packed_.begin() + q * dimension);
      norms_[q] = squaredNorm(query, dimension);
      float_norms_[q] = static_cast<float>(norms_[q]);
      thresholds_[q] = std::numeric_limits<float>::max();
    }
    std::sort(seeds_.begin(), seeds_.end());
    seeds_.erase(std::unique(seeds_.begin(), seeds_.end()), seeds_.end());
    // Neighbours in the list are mostly neighbours in space, with like descriptors: what
    // matched the queries before is a good first guess, and spares many an offer.
    for (std::size_t q = 0; q < QUERY_BLOCK; ++q)
      if (thresholds_[q] > 0)
        for (const std::int32_t seed : seeds_)
          offer(first, q, static_cast<std::size_t>(seed), false);
  }

  void
  offer(std::size_t first, std::size_t q, std::size_t target, bool backward)
  {
    const std::size_t query = first + q;
    const double distance = squaredDistance(
        descriptor(queries_, query), descriptor(targets_, target), queries_.dimension);
    if (forward_.offer(q, {distance, static_cast<std::int32_t>(target)}) &&
        forward_.worst(q) < std::numeric_limits<double>::infinity())
      thresholds_[q] = static_cast<float>(
          forward_.worst(q) - norms_[q] +
          filterError(norms_[q], blocks_.largest_norm, queries_.dimension));
    if (backward &&
        backward_.offer(target, {distance, static_cast<std::int32_t>(query)}) &&
        backward_.worst(target) < std::numeric_limits<double>::infinity())
      limits_[target] = static_cast<float>(backward_.worst(target) + limit_error_);
  }

  const FeatureView& queries_;
  const FeatureView& targets_;
  const TargetBlocks& blocks_;
  const cpu::Kernels& kernels_;
  const bool both_ways_;
  const double limit_error_;
  std::vector<float> packed_;
  NearestLists forward_, backward_;
  AlignedBuffer<float> limits_;
  std::vector<std::int32_t> seeds_;
  double norms_[QUERY_BLOCK] = {};
  float float_norms_[QUERY_BLOCK] = {};
  float thresholds_[QUERY_BLOCK] = {};
};

void
append(std::vector<FeatureMatch>& matches,
       std::size_t query,
       const Candidate* begin,
       const Candidate* end)
{
  for (; begin != end; ++begin)
    matches.push_back({static_cast<std::int32_t>(query),
                       begin->index,
                       static_cast<float>(begin->squared_distance)});
}

/** \brief What all threads found for the targets. The k best of all are among the k best of
 * each, whoever searched for which queries. */
std::vector<FeatureMatch>
mergeBackward(const std::vector<std::optional<BlockSearch>>& searches,
              std::size_t targets,
              std::size_t k)
{
  NearestLists merged(targets, k);
  for (const std::optional<BlockSearch>& search : searches)
    for (std::size_t t = 0; search && t < targets; ++t)
      for (const Candidate* match = search->backward().begin(t);
           match != search->backward().end(t);
           ++match)
        merged.offer(t, *match);
  std::vector<FeatureMatch> matches;
  matches.reserve(targets * k);
  for (std::size_t t = 0; t < targets; ++t)
    append(matches, t, merged.begin(t), merged.end(t));
  return matches;
}

double
largestNorm(const FeatureView& view)
{
  double largest = 0;
  for (std::size_t i = 0; i < view.size; ++i)
    if (allFinite(descriptor(view, i), view.dimension))
      largest = std::max(largest, squaredNorm(descriptor(view, i), view.dimension));
  return largest;
}

MutualMatches
search(const FeatureView& queries,
       const FeatureView& targets,
       std::size_t k,
       cpu::ThreadPool& pool,
       bool both_ways)
{
  check("queries", queries);
  check("targets", targets);
  if (k == 0)
    throw std::invalid_argument("k = 0 is out of range: it must be >= 1");
  if (queries.size == 0 || targets.size == 0)
    return {};
  if (queries.dimension != targets.dimension)
    throw std::invalid_argument(
        "queries have dimension " + std::to_string(queries.dimension) +
        ", targets have dimension " + std::to_string(targets.dimension));

  const cpu::Kernels& kernels = cpu::selectKernels();
  const TargetBlocks blocks(targets);
  const double largest_query_norm = both_ways ? largestNorm(queries) : 0;
  const std::size_t forward_k = std::min(k, targets.size);
  const std::size_t backward_k = std::min(k, queries.size);
  const std::size_t list_length = std::max(forward_k, backward_k);
  const std::size_t task_size = BLOCKS_A_TASK * QUERY_BLOCK;
  const std::size_t tasks = (queries.size + task_size - 1) / task_size;
  std::vector<std::vector<FeatureMatch>> found(tasks);
  std::vector<std::optional<BlockSearch>> searches(pool.size());
  pool.forEach(tasks, [&](std::size_t task, std::size_t thread) {
    if (!searches[thread])
      searches[thread].emplace(queries,
                               targets,
                               blocks,
                               largest_query_norm,
                               list_length,
                               both_ways,
                               kernels);
    const std::size_t end = std::min(queries.size, (task + 1) * task_size);
    for (std::size_t first = task * task_size; first < end; first += QUERY_BLOCK) {
      const NearestLists& lists = searches[thread]->run(first);
      for (std::size_t q = 0; q < QUERY_BLOCK; ++q)
        append(found[task], first + q, lists.begin(q), lists.end(q));
    }
  });

  MutualMatches matches;
  matches.forward.reserve(queries.size * forward_k);
  for (const std::vector<FeatureMatch>& part : found)
    matches.forward.insert(matches.forward.end(), part.begin(), part.end());
  if (both_ways)
    matches.backward = mergeBackward(searches, targets.size, list_length);
  return matches;
}

} // namespace

class FeatureMatcher::Impl {
public:
  explicit Impl(unsigned num_threads) : pool(num_threads) {}

  cpu::ThreadPool pool;
};

FeatureMatcher::FeatureMatcher(unsigned num_threads)
    : impl_(std::make_unique<Impl>(num_threads))
{
}

FeatureMatcher::~FeatureMatcher() = default;
FeatureMatcher::FeatureMatcher(FeatureMatcher&&) noexcept = default;
FeatureMatcher&
FeatureMatcher::operator=(FeatureMatcher&&) noexcept = default;

std::vector<FeatureMatch>
FeatureMatcher::match(const FeatureView& queries,
                      const FeatureView& targets,
                      std::size_t k)
{
  return search(queries, targets, k, impl_->pool, false).forward;
}

MutualMatches
FeatureMatcher::matchBothWays(const FeatureView& queries,
                              const FeatureView& targets,
                              std::size_t k)
{
  return search(queries, targets, k, impl_->pool, true);
}

std::vector<FeatureMatch>
matchFeatures(const FeatureView& queries,
              const FeatureView& targets,
              std::size_t k,
              unsigned num_threads)
{
  return FeatureMatcher(num_threads).match(queries, targets, k);
}

MutualMatches
matchFeaturesBothWays(const FeatureView& queries,
                      const FeatureView& targets,
                      std::size_t k,
                      unsigned num_threads)
{
  return FeatureMatcher(num_threads).matchBothWays(queries, targets, k);
}

std::vector<FeatureMatch>
MutualMatches::mutual() const
{
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  pairs.reserve(backward.size());
  for (const FeatureMatch& match : backward)
    pairs.emplace_back(match.match, match.query);
  std::sort(pairs.begin(), pairs.end());
  std::vector<FeatureMatch> both;
  for (const FeatureMatch& match : forward)
    if (std::binary_search(
            pairs.begin(), pairs.end(), std::make_pair(match.query, match.match)))
      both.push_back(match);
  return both;
}

} // namespace pcl_flashreg
