// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/aligned_buffer.h"
#include "simd/kernels.h"
#include "support/thread_pool.h"
#include "estimation/cpu/residual_test.h"
#include "estimation/pipeline.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pcl_flashreg {
namespace cpu {

/** \brief The seven stages on the CPU, and the memory between them. Every member function
 * named after a stage stands in the file of that name. */
class Stages {
public:
  Stages(const Kernels& kernels, ThreadPool& pool) : kernels_(kernels), pool_(pool) {}

  void
  begin(const Problem& problem,
        const Parameters& parameters,
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
  std::vector<Pose>
  candidates() const;
  void
  finish(double StageTimings::*stage)
  {
    clock_->finish(stage);
  }
  bool
  settled() const
  {
    return true;
  }
  PoseEstimate
  result();
  void
  copyTo(Trace& trace) const;

private:
  /** \brief Number of correspondences. */
  std::size_t
  size() const
  {
    return problem_->size;
  }
  /** \brief Neighbours of correspondence i, words_ words. */
  const std::uint64_t*
  row(std::size_t i) const
  {
    return graph_.data() + i * words_;
  }

  // first_order_graph.cpp
  EdgeTestInput
  edgeTestInput();
  void
  testBlock(const EdgeTestInput& input,
            std::size_t row_block,
            std::size_t column_block,
            std::uint64_t edges[WORD_BITS]);
  void
  fillTile(const EdgeTestInput& input, std::size_t tile_row, std::size_t tile_column);

  // second_order_graph.cpp
  std::size_t
  rowsATask() const;
  void
  countDegrees();
  std::size_t
  countNeighboursAbove(std::size_t i) const;
  void
  scoreExactly();
  void
  scoreBounded();
  void
  scoreRowBounded(std::size_t u, std::size_t thread);

  // pivots.cpp
  void
  pivotsExact();
  void
  pivotsBounded();

  // cliques.cpp
  std::size_t
  cliquesExact(const Edge& pivot, std::size_t thread, Clique* best);
  std::size_t
  cliquesBounded(const Edge& pivot, Clique* best) const;

  // verification.cpp
  ResidualTest
  residualTest() const
  {
    return {kernels_, *problem_, parameters_->inlier_distance};
  }
  /** \brief Inliers of a pose as a bit set of problem_->padded_size bits.
   * \param[out] inliers, scratch both padded_size / 64 words
   * \return how many they are
   */
  int
  findInliers(const PoseF& pose, std::uint64_t* inliers, std::uint64_t* scratch) const;
  std::int64_t
  scoreOf(const PoseF& pose,
          std::size_t first_word,
          std::size_t words,
          const std::uint64_t* inliers,
          int inlier_count) const;

  // refinement.cpp
  ScoredPose
  refine(const Pose& start);
  bool
  explained(std::size_t i, std::size_t listed) const;
  std::vector<std::uint32_t>
  rankHypotheses() const;

  const Kernels& kernels_;
  ThreadPool& pool_;
  const Problem* problem_ = nullptr;
  const Parameters* parameters_ = nullptr;
  std::optional<Pose> guess_;
  StageClock* clock_ = nullptr;

  // Stage 1. The bit matrix: padded_size rows of words_ words, symmetric, zero diagonal.
  std::size_t words_ = 0;
  AlignedBuffer<std::uint64_t> graph_;
  AlignedBuffer<float> source_norm_, target_norm_;

  // Stage 2, exact: scores of the upper triangle, row by row in column order; row i has
  // those from row_begin_[i] to row_begin_[i + 1]; an edge without common neighbours
  // scores 0. row_best_ is the best score in the row.
  bool exact_ = true;
  std::vector<std::uint32_t> degrees_;
  std::vector<std::size_t> row_begin_;
  AlignedBuffer<std::uint32_t> scores_;
  std::vector<std::uint32_t> row_best_;
  // Stage 2, bounded: ELLPACK-R rows of row_capacity entries, and the candidate pools.
  std::vector<std::uint32_t> ell_columns_, ell_scores_, ell_length_;
  std::vector<std::uint32_t> pool_columns_, pool_scores_, pool_length_;
  // Scratch of stages 2 and 4, one a thread.
  struct Scratch {
    AlignedBuffer<std::uint64_t> voters;
    std::vector<std::uint32_t> columns, ranks_u, ranks_v;
  };
  std::vector<Scratch> scratch_;

  // Stages 3 and 4.
  std::vector<Edge> pivots_;
  std::vector<Clique> clique_slots_;
  std::vector<std::uint32_t> clique_counts_;
  std::vector<Clique> cliques_;

  // Stages 5 and 6: one a clique, the guess last. scores are -1 where not valid.
  std::vector<Pose> poses_;
  std::vector<char> pose_valid_;
  std::vector<std::int64_t> pose_scores_;

  // Stage 7: inliers of the pose at hand, and of every hypothesis that is listed.
  AlignedBuffer<std::uint64_t> inlier_words_, possible_words_, listed_inliers_;
  std::vector<ScoredPose> listed_;
};

} // namespace cpu
} // namespace pcl_flashreg
