// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ablation_stages.h"

#include "cuda/estimation/cuda_backend.h"
#include "dense_cliques.cuh"
#include "dense_graph.cuh"
#include "dense_scores.cuh"
#include "dense_verification.cuh"

#include <pcl_flashreg/estimator.h>

#include <limits>
#include <string>

namespace pcl_flashreg::benchmark {
namespace {

/** \brief The project's own part: no memory for what the row does densely. */
cuda::Options
optionsOf(const AblationRow& row)
{
  cuda::Options options;
  options.fused = row.fused;
  options.bits = row.fast_fog || row.sparse();
  options.lists = row.sparse();
  options.candidates = row.own_rest;
  return options;
}

bool
hasDenseGraph(const AblationRow& row)
{
  return !row.fast_fog || !row.sparse();
}

} // namespace

AblationStages::AblationStages(const AblationRow& row)
    : row_(row), own_(cuda::makeStages(optionsOf(row)))
{
  if (!row.sparse())
    product_.emplace(own_.stream());
}

void
AblationStages::begin(const Problem& problem,
                      Parameters parameters,
                      const std::optional<Pose>& guess,
                      StageClock& clock)
{
  parameters.second_order = row_.second_order == SecondOrderModule::FastSog
                                ? SecondOrder::Bounded
                                : SecondOrder::Exact;
  own_.begin(problem, parameters, guess, clock);
  reserve();
}

void
AblationStages::reserve()
{
  const std::size_t n = own_.call().size, stride = dense::strideOf(n);
  if (n * stride > std::numeric_limits<int>::max())
    throw BackendError("backend cuda: " + std::to_string(n) +
                       " correspondences are too many for a dense matrix of scores");
  if (row_.second_order == SecondOrderModule::HalfProduct)
    half_graph_.reserve(n * stride);
  else if (hasDenseGraph(row_))
    graph_.reserve(n * stride);
  if (!row_.dataflow) {
    scores_.reserve(n * stride);
    positives_.reserve(1);
  }
  if (!row_.own_rest)
    residuals_.reserve(own_.call().slots * stride);
}

template <typename Value>
dense::Matrix<Value>
AblationStages::matrix(const cuda::DeviceBuffer<Value>& buffer) const
{
  return {buffer.data(), dense::strideOf(own_.call().size)};
}

/** \brief Calls body with the dense first-order graph in the precision that it has. */
template <typename Body>
void
AblationStages::withGraph(const Body& body) const
{
  if (row_.second_order == SecondOrderModule::HalfProduct)
    body(matrix(half_graph_));
  else
    body(matrix(graph_));
}

void
AblationStages::firstOrderGraph()
{
  const cuda::Call& call = own_.call();
  const cudaStream_t stream = own_.stream().get();
  if (row_.fast_fog)
    own_.firstOrderGraph();
  else
    withGraph([&](auto graph) { dense::firstOrderGraph(call, graph, stream); });
  if (row_.fast_fog && !row_.sparse())
    withGraph([&](auto graph) { dense::toMatrix(call, graph, stream); });
  if (!row_.fast_fog && row_.sparse())
    dense::toBits(call, matrix(graph_), stream);
}

template <typename Value>
void
AblationStages::densely(dense::Matrix<Value> graph)
{
  const cuda::Call& call = own_.call();
  const cudaStream_t stream = own_.stream().get();
  PCL_FLASHREG_CUDA(cudaMemsetAsync(call.control, 0, sizeof(cuda::Control), stream));
  product_->square(graph, matrix(scores_), call.size);
  dense::maskScores(call, graph, matrix(scores_), positives_.data(), stream);
}

void
AblationStages::secondOrderGraph()
{
  const cudaStream_t stream = own_.stream().get();
  if (!row_.dataflow)
    PCL_FLASHREG_CUDA(
        cudaMemsetAsync(positives_.data(), 0, sizeof *positives_.data(), stream));
  if (!row_.sparse())
    withGraph([&](auto graph) { densely(graph); });
  else
    own_.secondOrderGraph();
  if (row_.sparse() && !row_.dataflow)
    dense::scatterScores(own_.call(), matrix(scores_), positives_.data(), stream);
}

void
AblationStages::pivots()
{
  if (row_.dataflow)
    own_.pivots();
  else
    pivots_.select(own_.call(), matrix(scores_), positives_.data(), own_.stream());
}

void
AblationStages::cliques()
{
  if (row_.dataflow)
    own_.cliques();
  else
    dense::cliques(own_.call(), matrix(scores_), own_.stream().get());
}

void
AblationStages::hypotheses()
{
  own_.hypotheses();
}

void
AblationStages::verification()
{
  if (row_.own_rest)
    own_.verification();
  else
    dense::verification(own_.call(), matrix(residuals_), own_.stream().get());
}

void
AblationStages::refinement()
{
  if (row_.own_rest)
    own_.refinement();
  else
    refinement_.run(own_.call(), own_.stream());
}

void
AblationStages::finish(double StageTimings::*stage)
{
  if (!row_.pivotsInSecondOrder())
    own_.finish(stage);
  else if (stage == &StageTimings::pivots)
    own_.finish(&StageTimings::second_order_graph);
  else if (stage != &StageTimings::second_order_graph)
    own_.finish(stage);
}

bool
AblationStages::settled()
{
  return own_.settled();
}

PoseEstimate
AblationStages::result() const
{
  return own_.result();
}

std::vector<Pose>
AblationStages::candidates() const
{
  return own_.candidates();
}

template <typename Value>
std::vector<Value>
AblationStages::download(dense::Matrix<Value> matrix) const
{
  std::vector<Value> values(own_.call().size * matrix.stride);
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(values.data(),
                                    matrix.values,
                                    values.size() * sizeof(Value),
                                    cudaMemcpyDeviceToHost,
                                    own_.stream().get()));
  own_.stream().synchronize();
  return values;
}

/** \brief The graphs are the dense ones where the row has them. */
void
AblationStages::copyTo(Trace& trace) const
{
  own_.copyTo(trace);
  const std::size_t n = trace.size, stride = dense::strideOf(n);
  if (hasDenseGraph(row_))
    withGraph([&](auto matrix) {
      const auto values = download(matrix);
      trace.first_order_graph.assign(n * trace.words_per_row, 0);
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
          if (dense::isEdge(values[i * stride + j]))
            trace.first_order_graph[i * trace.words_per_row + j / WORD_BITS] |=
                std::uint64_t{1} << (j % WORD_BITS);
    });
  if (row_.dataflow)
    return;
  const std::vector<float> scores = download(matrix(scores_));
  trace.second_order_graph.clear();
  for (std::uint32_t u = 0; u < n; ++u)
    for (std::uint32_t v = u + 1; v < n; ++v)
      if (scores[u * stride + v] > 0)
        trace.second_order_graph.push_back(
            {u, v, static_cast<std::uint32_t>(scores[u * stride + v])});
}

std::size_t
AblationStages::deviceBytes() const
{
  return own_.deviceBytes() + graph_.bytes() + half_graph_.bytes() + scores_.bytes() +
         positives_.bytes() + (product_ ? product_->deviceBytes() : 0) +
         pivots_.deviceBytes() + residuals_.bytes() + refinement_.deviceBytes();
}

} // namespace pcl_flashreg::benchmark
