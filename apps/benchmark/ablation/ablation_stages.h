// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "ablation_row.h"
#include "dense_matrix.cuh"
#include "dense_pivots.cuh"
#include "dense_product.h"
#include "dense_refinement.cuh"
#include "cuda/support/memory.h"
#include "cuda/estimation/stages.h"

#include <optional>

namespace pcl_flashreg::benchmark {

/** \brief The seven stages as a row of the ablation has them, for runPipeline(). They read
 * and leave what cuda::Stages has, which does all that the row doesn't do densely.
 *
 * Where a stage reads another form than the one before it puts out, writing that form counts
 * as part of the one before.
 */
class AblationStages {
public:
  /** \throws BackendError if there is no device, or none of the memory */
  explicit AblationStages(const AblationRow& row);

  /** \param[in] parameters SecondOrder is the row's and not theirs */
  void
  begin(const Problem& problem,
        Parameters parameters,
        const std::optional<Pose>& guess,
        StageClock& clock);
  void
  firstOrderGraph();
  void
  secondOrderGraph();
  void
  pivots();
  void
  cliques();
  void
  hypotheses();
  void
  verification();
  void
  refinement();
  void
  finish(double StageTimings::*stage);
  bool
  settled();
  PoseEstimate
  result() const;
  std::vector<Pose>
  candidates() const;
  void
  copyTo(Trace& trace) const;

  /** \brief Bytes of device memory that are held: the most of all calls so far, since
   * buffers only grow. */
  std::size_t
  deviceBytes() const;

private:
  void
  reserve();
  template <typename Value>
  void
  densely(dense::Matrix<Value> graph);
  template <typename Body>
  void
  withGraph(const Body& body) const;
  template <typename Value>
  dense::Matrix<Value>
  matrix(const cuda::DeviceBuffer<Value>& buffer) const;
  template <typename Value>
  std::vector<Value>
  download(dense::Matrix<Value> matrix) const;

  const AblationRow row_;
  cuda::Stages own_;
  /** \brief The first-order graph: one of these, where the row has it densely. */
  cuda::DeviceBuffer<float> graph_;
  cuda::DeviceBuffer<dense::Half> half_graph_;
  /** \brief The second-order graph, and how many positive scores there are. */
  cuda::DeviceBuffer<float> scores_;
  cuda::DeviceBuffer<unsigned long long> positives_;
  std::optional<dense::Product> product_;
  dense::Pivots pivots_;
  cuda::DeviceBuffer<float> residuals_;
  dense::Refinement refinement_;
};

} // namespace pcl_flashreg::benchmark
