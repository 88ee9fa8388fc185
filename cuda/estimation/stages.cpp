// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cuda/estimation/stages.h"

#include "cuda/estimation/cliques.cuh"
#include "cuda/estimation/first_order_graph.cuh"
#include "cuda/estimation/hypotheses.cuh"
#include "cuda/estimation/pivots.cuh"
#include "cuda/estimation/refinement.cuh"
#include "cuda/estimation/second_order_graph.cuh"
#include "cuda/estimation/verification.cuh"

#include <pcl_flashreg/estimator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_flashreg {
namespace cuda {
namespace {

/** \brief Lists are addressed by 32 bits. */
constexpr unsigned long long MOST_ENTRIES = std::numeric_limits<unsigned>::max();

constexpr std::size_t
roundUp(std::size_t n, std::size_t unit)
{
  return (n + unit - 1) / unit * unit;
}

} // namespace

Stages::Stages(const Options& options, unsigned multiprocessors, bool cooperative)
    : options_(options), multiprocessors_(multiprocessors), cooperative_(cooperative)
{
  call_.exact = true;
}

void
Stages::begin(const Problem& problem,
              const Parameters& parameters,
              const std::optional<Pose>& guess,
              StageClock& clock)
{
  clock_ = &clock;
  ended_count_ = 0;
  describe(problem, parameters);
  call_.has_guess = guess.has_value();
  if (guess)
    call_.guess = *guess;
  reserveHypotheses();
  reserveReport();
  if (options_.bits)
    graph_.reserve(std::size_t{call_.padded} * call_.words);
  call_.graph = graph_.data();
  if (parameters.second_order == SecondOrder::Exact)
    call_.exact = true;
  if (parameters.second_order == SecondOrder::Bounded)
    call_.exact = false;
  if (options_.lists && call_.exact)
    planExact(static_cast<unsigned long long>(options_.expected_degree) * call_.size);
  else if (options_.lists)
    planBounded();
  if (!options_.resident_points || !uploaded_)
    upload(problem);
  if (options_.stage_timings)
    beginning_.record(stream_.get());
}

void
Stages::describe(const Problem& problem, const Parameters& p)
{
  Call& c = call_;
  c.size = static_cast<unsigned>(problem.size);
  c.padded =
      static_cast<unsigned>(roundUp(std::max<std::size_t>(1, problem.size), ROW_BITS));
  c.words = c.padded / 32;
  c.radius = problem.radius;
  c.length_tolerance = p.length_tolerance;
  c.min_length_sum = p.min_length_sum;
  c.inlier_distance = p.inlier_distance;
  const std::size_t pairs =
      problem.size * (std::max<std::size_t>(1, problem.size) - 1) / 2;
  c.pivots = static_cast<unsigned>(std::min(pairs, static_cast<std::size_t>(p.pivots)));
  c.cliques_per_pivot = static_cast<unsigned>(p.cliques_per_pivot);
  c.row_capacity = static_cast<unsigned>(p.row_capacity);
  c.pool_capacity = static_cast<unsigned>(p.pool_capacity);
  c.max_hypotheses = static_cast<unsigned>(p.max_hypotheses);
  c.refinement_iterations = static_cast<unsigned>(p.refinement_iterations);
  c.second_order = p.second_order;
  c.metric = p.score_metric;
  c.filter = edgeFilter(problem.radius, p.length_tolerance, p.min_length_sum);
  c.upright = problem.upright;
  c.height_margin = heightMargin(problem.radius, problem.upright.squared_slope);
}

void
Stages::upload(const Problem& problem)
{
  const std::size_t n = call_.padded;
  const AlignedBuffer<float>* columns[] = {&problem.sx,
                                           &problem.sy,
                                           &problem.sz,
                                           &problem.tx,
                                           &problem.ty,
                                           &problem.tz,
                                           &problem.rise};
  const std::size_t count = problem.upright.required ? 7 : 6;
  staging_.reserve(count * n);
  points_.reserve(count * n);
  for (std::size_t k = 0; k < count; ++k) {
    float* to = staging_.data() + k * n;
    std::copy_n(columns[k]->data(), problem.size, to);
    std::fill(to + problem.size, to + n, std::numeric_limits<float>::quiet_NaN());
  }
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(points_.data(),
                                    staging_.data(),
                                    count * n * sizeof(float),
                                    cudaMemcpyHostToDevice,
                                    stream_.get()));
  const float* points = points_.data();
  call_.sx = points;
  call_.sy = points + n;
  call_.sz = points + 2 * n;
  call_.tx = points + 3 * n;
  call_.ty = points + 4 * n;
  call_.tz = points + 5 * n;
  call_.rise = points + 6 * n;
  uploaded_ = true;
}

/** \brief Stages 3 to 7. */
void
Stages::reserveHypotheses()
{
  const std::size_t size = call_.size;
  const std::size_t cliques = std::size_t{call_.pivots} * call_.cliques_per_pivot;
  row_best_.reserve(size);
  tie_begin_.reserve(roundUp(size, 4));
  pivot_keys_.reserve(2 * std::size_t{call_.pivots});
  cliques_.reserve(cliques);
  clique_counts_.reserve(call_.pivots);
  call_.slots = static_cast<unsigned>(cliques + 1);
  poses_.reserve(call_.slots);
  slot_poses_.reserve(call_.slots);
  pose_scores_.reserve(call_.slots);
  if (options_.candidates) {
    candidate_inliers_.reserve(std::size_t{MOST_CANDIDATES} * call_.words);
    candidate_lists_.reserve(std::size_t{MOST_CANDIDATES} * call_.padded);
  }
  call_.row_best = row_best_.data();
  call_.tie_begin = tie_begin_.data();
  call_.pivot_keys = pivot_keys_.data();
  call_.pivot_keys_other = pivot_keys_.data() + call_.pivots;
  call_.cliques = cliques_.data();
  call_.clique_counts = clique_counts_.data();
  call_.poses = poses_.data();
  call_.slot_poses = slot_poses_.data();
  call_.scores = pose_scores_.data();
  call_.candidate_inliers = candidate_inliers_.data();
  call_.candidate_lists = candidate_lists_.data();
}

void
Stages::reserveReport()
{
  constexpr std::size_t line = 128;
  const std::size_t bins = std::max(call_.size, call_.row_capacity) + std::size_t{1};
  control_offset_ = roundUp(bins * sizeof(unsigned), line);
  cleared_bytes_ = control_offset_ + sizeof(Control);
  listed_offset_ = roundUp(sizeof(Control), line);
  cliques_offset_ =
      roundUp(listed_offset_ + call_.max_hypotheses * sizeof(ScoredPose), line);
  inliers_offset_ = roundUp(cliques_offset_ + LISTED_CLIQUES * sizeof(Clique), line);
  const std::size_t set_bytes = call_.words * sizeof(unsigned);
  read_bytes_ = inliers_offset_ + set_bytes;
  report_.reserve(control_offset_ + inliers_offset_ + call_.max_hypotheses * set_bytes);
  host_report_.reserve(read_bytes_);
  unsigned char* control = report_.data() + control_offset_;
  call_.histogram = reinterpret_cast<unsigned*>(report_.data());
  call_.control = reinterpret_cast<Control*>(control);
  call_.listed = reinterpret_cast<ScoredPose*>(control + listed_offset_);
  call_.listed_cliques = reinterpret_cast<Clique*>(control + cliques_offset_);
  call_.listed_inliers = reinterpret_cast<unsigned*>(control + inliers_offset_);
}

/** \param[in] entries of the first-order graph that there shall be room for */
void
Stages::planExact(unsigned long long entries)
{
  if (entries > MOST_ENTRIES)
    throw BackendError(
        "backend cuda: the first-order graph has " + std::to_string(entries) +
        " entries, too many for second_order = exact; use auto or bounded");
  columns_.reserve(entries);
  scores_.reserve(entries / 2);
  neighbour_rows_.reserve(call_.size);
  rows_.reserve(call_.size);
  call_.exact = true;
  call_.entry_capacity = std::min<unsigned long long>(
      {columns_.capacity(), 2 * scores_.capacity(), MOST_ENTRIES});
  call_.neighbours = columns_.data();
  call_.neighbour_rows = neighbour_rows_.data();
  call_.upper = {columns_.data(), scores_.data(), rows_.data()};
  call_.pool = call_.upper;
}

void
Stages::planBounded()
{
  const std::size_t n = call_.size;
  columns_.reserve(n * call_.row_capacity);
  scores_.reserve(n * call_.row_capacity);
  rows_.reserve(n);
  pool_columns_.reserve(n * call_.pool_capacity);
  pool_scores_.reserve(n * call_.pool_capacity);
  pool_rows_.reserve(n);
  call_.exact = false;
  call_.entry_capacity = 0;
  call_.upper = {columns_.data(), scores_.data(), rows_.data()};
  call_.pool = {pool_columns_.data(), pool_scores_.data(), pool_rows_.data()};
}

void
Stages::firstOrderGraph()
{
  cuda::firstOrderGraph(call_, stream_.get());
}

void
Stages::secondOrderGraph()
{
  PCL_FLASHREG_CUDA(cudaMemsetAsync(report_.data(), 0, cleared_bytes_, stream_.get()));
  listNeighbours(call_, stream_.get());
  if (call_.exact)
    scoreExactly(call_, stream_.get());
  else if (fused())
    scoreBoundedAndSelect(call_, multiprocessors_, stream_.get());
  else
    scoreBounded(call_, multiprocessors_, stream_.get());
}

void
Stages::pivots()
{
  if (call_.exact || !fused())
    selectPivots(call_, stream_.get());
  sortPivots(call_, stream_.get());
}

void
Stages::cliques()
{
  cuda::cliques(call_, stream_.get());
}

void
Stages::hypotheses()
{
  cuda::hypotheses(call_, stream_.get());
}

void
Stages::verification()
{
  cuda::verification(call_, stream_.get());
}

void
Stages::refinement()
{
  cuda::refinement(call_, fused(), multiprocessors_, stream_.get());
}

void
Stages::finish(double StageTimings::*stage)
{
  if (!options_.stage_timings)
    return;
  ended_[ended_count_] = stage;
  ends_[ended_count_++].record(stream_.get());
}

/** \brief Waits for the device. Where stage 2 had not the form or the room that the input
 * calls for, makes the next attempt from stage 2 on fit. */
bool
Stages::settled()
{
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(host_report_.data(),
                                    call_.control,
                                    read_bytes_,
                                    cudaMemcpyDeviceToHost,
                                    stream_.get()));
  stream_.synchronize();
  const unsigned long long entries = control().entries;
  if (planHolds(call_, entries)) {
    bookTimes();
    return true;
  }
  // A little more than is needed, so that an input a little larger fits, too; but not more
  // than `auto` could ever ask for.
  const unsigned long long limit = 8ull * call_.row_capacity * call_.size;
  if (callsForExact(call_, entries))
    planExact(std::max(entries, std::min(entries + entries / 8, limit)));
  else
    planBounded();
  ended_count_ = std::min<std::size_t>(ended_count_, 1);
  return false;
}

void
Stages::bookTimes()
{
  const Event* last = &beginning_;
  for (std::size_t i = 0; i < ended_count_; ++i) {
    clock_->book(ended_[i], last->millisecondsTo(ends_[i]));
    last = &ends_[i];
  }
}

PoseEstimate
Stages::result() const
{
  const Control& c = control();
  PoseEstimate estimate;
  estimate.second_order = call_.exact ? SecondOrder::Exact : SecondOrder::Bounded;
  if (c.any_clique || call_.has_guess)
    estimate.status = Status::Degenerate;
  const auto* listed =
      reinterpret_cast<const ScoredPose*>(host_report_.data() + listed_offset_);
  if (c.listed_count == 0 || listed[0].inlier_count < 3)
    return estimate;
  estimate.status = Status::Ok;
  estimate.hypotheses.assign(listed, listed + c.listed_count);
  const auto* cliques =
      reinterpret_cast<const Clique*>(host_report_.data() + cliques_offset_);
  for (unsigned slot = 0; slot < std::min(LISTED_CLIQUES, call_.slots); ++slot)
    if (cliques[slot].score > 0)
      estimate.cliques.push_back(cliques[slot]);
  const auto* inliers =
      reinterpret_cast<const unsigned*>(host_report_.data() + inliers_offset_);
  estimate.inliers.reserve(static_cast<std::size_t>(listed[0].inlier_count));
  for (unsigned w = 0; w < call_.words; ++w)
    for (unsigned bits = inliers[w]; bits != 0; bits &= bits - 1)
      estimate.inliers.push_back(static_cast<int>(32 * w) + __builtin_ctz(bits));
  return estimate;
}

std::size_t
Stages::deviceBytes() const
{
  const auto sum = [](const auto&... buffers) {
    return (std::size_t{0} + ... + buffers.bytes());
  };
  return sum(points_,
             graph_,
             columns_,
             scores_,
             neighbour_rows_,
             rows_,
             pool_rows_,
             pool_columns_,
             pool_scores_,
             row_best_,
             tie_begin_,
             pivot_keys_,
             cliques_,
             clique_counts_,
             poses_,
             slot_poses_,
             pose_scores_,
             candidate_inliers_,
             candidate_lists_,
             report_);
}

void
Stages::abandon() noexcept
{
  cudaStreamSynchronize(stream_.get());
  cudaGetLastError();
}

} // namespace cuda
} // namespace pcl_flashreg
