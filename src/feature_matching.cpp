// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Exhaustive nearest neighbours in feature space. Inner products in single precision rule
// out nearly every pair; what could be among the k best is measured in double precision,
// so that the result is that of an exhaustive search in double precision.

#include <pcl_flashreg/feature_matching.h>

#include "aligned_buffer.h"
#include "cpu/kernels/kernels.h"
#include "cpu/thread_pool.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace pcl_flashreg {
namespace {

using cpu::FEATURE_BLOCK;
using cpu::QUERY_BLOCK;

/** \brief Blocks of queries in a task. */
constexpr std::size_t BLOCKS_A_TASK = 8;

struct Candidate {
  double squared_distance;
  std::int32_t target;

  bool
  operator<(const Candidate& other) const
  {
    return squared_distance != other.squared_distance
               ? squared_distance < other.squared_distance
               : target < other.target;
  }
};

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
  double sum = 0;
  for (std::size_t d = 0; d < n; ++d) {
    const double difference = static_cast<double>(a[d]) - b[d];
    sum += difference * difference;
  }
  return sum;
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

/** \brief Finds the matches of up to QUERY_BLOCK queries. */
class BlockSearch {
public:
  BlockSearch(const FeatureView& queries,
              const FeatureView& targets,
              const TargetBlocks& blocks,
              std::size_t k,
              const cpu::Kernels& kernels)
      : queries_(queries),
        targets_(targets),
        blocks_(blocks),
        k_(k),
        kernels_(kernels),
        packed_(QUERY_BLOCK * queries.dimension)
  {
  }

  /** \param[out] best the matches of query first + q in best[q], best first */
  void
  run(std::size_t first, std::vector<Candidate> best[QUERY_BLOCK])
  {
    begin(first, best);
    const cpu::FeatureBlock input{
        blocks_.values.data(), blocks_.norms.data(), targets_.dimension};
    for (std::size_t block = 0; block < blocks_.count; ++block) {
      std::uint32_t candidates[QUERY_BLOCK];
      kernels_.featureCandidates(input, block, packed_.data(), thresholds_, candidates);
      for (std::size_t q = 0; q < QUERY_BLOCK; ++q)
        for (std::uint32_t bits = candidates[q]; bits != 0; bits &= bits - 1) {
          const std::size_t target = block * FEATURE_BLOCK + __builtin_ctz(bits);
          offer(first + q, target, q, best[q]);
        }
    }
  }

private:
  void
  begin(std::size_t first, std::vector<Candidate> best[QUERY_BLOCK])
  {
    const std::size_t dimension = queries_.dimension;
    std::fill(packed_.begin(), packed_.end(), 0.0f);
    for (std::size_t q = 0; q < QUERY_BLOCK; ++q) {
      best[q].clear();
      thresholds_[q] = -std::numeric_limits<float>::infinity();
      if (first + q >= queries_.size)
        continue;
      const float* query = descriptor(queries_, first + q);
      if (!allFinite(query, dimension))
        continue;
      std::copy(query, query + dimension, packed_.begin() + q * dimension);
      norms_[q] = squaredNorm(query, dimension);
      thresholds_[q] = std::numeric_limits<float>::max();
    }
  }

  void
  offer(std::size_t query,
        std::size_t target,
        std::size_t q,
        std::vector<Candidate>& best)
  {
    const Candidate candidate{squaredDistance(descriptor(queries_, query),
                                              descriptor(targets_, target),
                                              queries_.dimension),
                              static_cast<std::int32_t>(target)};
    if (best.size() == k_) {
      if (!(candidate < best.back()))
        return;
      best.pop_back();
    }
    best.insert(std::upper_bound(best.begin(), best.end(), candidate), candidate);
    if (best.size() == k_)
      thresholds_[q] = threshold(best.back().squared_distance, norms_[q]);
  }

  /** \brief The filter computes |t|^2 - 2 q.t, the squared distance less |q|^2. A sum of n
   * products errs by at most n u |q| |t|; the bound covers that and the other roundings
   * in any order of summation. */
  float
  threshold(double squared_distance, double query_norm) const
  {
    const double reach = std::sqrt(query_norm) + std::sqrt(blocks_.largest_norm);
    const double error =
        (static_cast<double>(queries_.dimension) + 8) / (1 << 23) * reach * reach;
    return static_cast<float>(squared_distance - query_norm + error);
  }

  const FeatureView& queries_;
  const FeatureView& targets_;
  const TargetBlocks& blocks_;
  const std::size_t k_;
  const cpu::Kernels& kernels_;
  std::vector<float> packed_;
  double norms_[QUERY_BLOCK] = {};
  float thresholds_[QUERY_BLOCK] = {};
};

} // namespace

std::vector<FeatureMatch>
matchFeatures(const FeatureView& queries,
              const FeatureView& targets,
              std::size_t k,
              unsigned num_threads)
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
  const std::size_t task_size = BLOCKS_A_TASK * QUERY_BLOCK;
  const std::size_t tasks = (queries.size + task_size - 1) / task_size;
  std::vector<std::vector<FeatureMatch>> found(tasks);
  cpu::ThreadPool(num_threads).forEach(tasks, [&](std::size_t task, std::size_t) {
    BlockSearch search(queries, targets, blocks, k, kernels);
    std::vector<Candidate> best[QUERY_BLOCK];
    for (std::size_t b = 0; b < BLOCKS_A_TASK; ++b) {
      const std::size_t first = task * task_size + b * QUERY_BLOCK;
      if (first >= queries.size)
        break;
      search.run(first, best);
      for (std::size_t q = 0; q < QUERY_BLOCK; ++q)
        for (const Candidate& match : best[q])
          found[task].push_back({static_cast<std::int32_t>(first + q),
                                 match.target,
                                 static_cast<float>(match.squared_distance)});
    }
  });

  std::vector<FeatureMatch> matches;
  matches.reserve(queries.size * std::min(k, targets.size));
  for (const std::vector<FeatureMatch>& part : found)
    matches.insert(matches.end(), part.begin(), part.end());
  return matches;
}

} // namespace pcl_flashreg
