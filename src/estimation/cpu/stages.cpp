// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/cpu/stages.h"

#include "estimation/backend.h"
#include "estimation/cpu/bits.h"

#include <string>

namespace pcl_flashreg {
namespace cpu {
namespace {

class CpuBackend : public Backend {
public:
  explicit CpuBackend(ThreadPool& pool)
      : kernels_(selectKernels()), stages_(kernels_, pool)
  {
  }

  std::string
  name() const override
  {
    return std::string("cpu-") + kernels_.name;
  }

  std::unique_ptr<Backend>
  another(ThreadPool& pool) const override
  {
    return std::make_unique<CpuBackend>(pool);
  }

  PoseEstimate
  run(const Problem& problem,
      const Parameters& parameters,
      const std::optional<Pose>& guess,
      bool with_candidates,
      StageClock& clock,
      Trace* trace) override
  {
    return runPipeline(
        stages_, problem, parameters, guess, with_candidates, clock, trace);
  }

private:
  const Kernels& kernels_;
  Stages stages_;
};

} // namespace

void
Stages::begin(const Problem& problem,
              const Parameters& parameters,
              const std::optional<Pose>& guess,
              StageClock& clock)
{
  problem_ = &problem;
  parameters_ = &parameters;
  guess_ = guess;
  clock_ = &clock;
  scratch_.resize(pool_.size());
}

PoseEstimate
Stages::result()
{
  PoseEstimate estimate;
  estimate.second_order = exact_ ? SecondOrder::Exact : SecondOrder::Bounded;
  if (!poses_.empty())
    estimate.status = Status::Degenerate;
  if (listed_.empty() || listed_.front().inlier_count < 3)
    return estimate;
  estimate.status = Status::Ok;
  estimate.hypotheses = listed_;
  const std::size_t T = parameters_->cliques_per_pivot;
  for (std::size_t slot = 0; slot < LISTED_CLIQUES && slot / T < pivots_.size(); ++slot)
    if (slot % T < clique_counts_[slot / T])
      estimate.cliques.push_back(clique_slots_[slot]);
  estimate.inliers.resize(listed_.front().inlier_count);
  listBits(listed_inliers_.data(),
           problem_->padded_size / WORD_BITS,
           estimate.inliers.data());
  return estimate;
}

void
Stages::copyTo(Trace& trace) const
{
  trace = Trace{};
  trace.size = size();
  trace.words_per_row = words_;
  trace.first_order_graph.assign(row(0), row(size()));
  std::vector<std::uint32_t> columns(size());
  const std::size_t L = parameters_->row_capacity, m = parameters_->pool_capacity;
  for (std::uint32_t u = 0; u < size(); ++u) {
    const std::size_t length =
        exact_ ? listBitsAbove(row(u), u, 0, words_, columns.data()) : ell_length_[u];
    for (std::size_t i = 0; i < length; ++i) {
      const Edge edge = exact_
                            ? Edge{u, columns[i], scores_[row_begin_[u] + i]}
                            : Edge{u, ell_columns_[u * L + i], ell_scores_[u * L + i]};
      if (edge.score > 0)
        trace.second_order_graph.push_back(edge);
    }
    for (std::size_t i = 0; !exact_ && i < pool_length_[u]; ++i)
      trace.pools.push_back({u, pool_columns_[u * m + i], pool_scores_[u * m + i]});
  }
  trace.pivots = pivots_;
  trace.cliques = cliques_;
  trace.hypotheses = poses_;
  trace.hypothesis_valid = pose_valid_;
  trace.scores = pose_scores_;
}

} // namespace cpu

std::unique_ptr<Backend>
makeCpuBackend(ThreadPool& pool)
{
  return std::make_unique<cpu::CpuBackend>(pool);
}

} // namespace pcl_flashreg
