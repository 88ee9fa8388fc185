// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 6: every hypothesis is scored on all correspondences.

#include "estimation/cpu/stages.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Hypotheses of a task; for each block of correspondences all of them are
 * evaluated. */
constexpr std::size_t POSES_A_TASK = 64;

} // namespace

std::int64_t
Stages::scoreOf(const PoseF& T,
                std::size_t first_word,
                std::size_t words,
                const std::uint64_t* inliers,
                int inlier_count) const
{
  const ScoreMetric metric = parameters_->score_metric;
  if (metric == ScoreMetric::Inliers)
    return inlier_count * SCORE_UNIT;
  const float limit = parameters_->inlier_distance;
  std::int64_t score = 0;
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t bits = inliers[w]; bits != 0; bits &= bits - 1) {
      const std::size_t i = (first_word + w) * WORD_BITS + __builtin_ctzll(bits);
      const float squared = squaredResidual(T, problem_->pair(i));
      score += metric == ScoreMetric::Mae ? maeScore(squared, limit)
                                          : mseScore(squared, limit);
    }
  return score;
}

int
Stages::findInliers(const PoseF& T,
                    std::uint64_t* inliers,
                    std::uint64_t* scratch) const
{
  const ResidualTest test = residualTest();
  return test(test.of(T), 0, problem_->padded_size / WORD_BITS, inliers, scratch);
}

void
Stages::verification()
{
  constexpr std::size_t BLOCK_WORDS = ResidualTest::BLOCK_WORDS;
  const std::size_t words = problem_->padded_size / WORD_BITS;
  const ResidualTest test = residualTest();
  pose_scores_.resize(poses_.size());
  const std::size_t tasks = (poses_.size() + POSES_A_TASK - 1) / POSES_A_TASK;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t) {
    const std::size_t begin = task * POSES_A_TASK;
    const std::size_t end = std::min(poses_.size(), begin + POSES_A_TASK);
    ResidualTest::Tested tested[POSES_A_TASK];
    for (std::size_t i = begin; i < end; ++i) {
      pose_scores_[i] = pose_valid_[i] ? 0 : -1;
      if (pose_valid_[i])
        tested[i - begin] = test.of(toSingle(poses_[i]));
    }
    for (std::size_t word = 0; word < words; word += BLOCK_WORDS) {
      const std::size_t block = std::min(BLOCK_WORDS, words - word);
      for (std::size_t i = begin; i < end; ++i) {
        if (!pose_valid_[i])
          continue;
        std::uint64_t inliers[BLOCK_WORDS], possible[BLOCK_WORDS];
        const ResidualTest::Tested& T = tested[i - begin];
        const int count = test(T, word, block, inliers, possible);
        pose_scores_[i] += scoreOf(T.pose, word, block, inliers, count);
      }
    }
  });
}

} // namespace cpu
} // namespace pcl_flashreg
