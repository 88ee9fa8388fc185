// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 6: every hypothesis is scored on all correspondences. As in stage 1, a contracted
// evaluation decides what is certain and the exact formula the rest, so that counts do not
// depend on the instruction set.

#include "estimation/cpu/bits.h"
#include "estimation/cpu/stages.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {
namespace {

/** \brief Hypotheses of a task; for each block of correspondences, which then stays in
 * the first-level cache, all of them are evaluated. */
constexpr std::size_t POSES_A_TASK = 64;
/** \brief Words of 64 correspondences in a block: 24 KiB of coordinates. */
constexpr std::size_t BLOCK_WORDS = 16;

} // namespace

ResidualInput
Stages::residualInput(const PoseF& T) const
{
  const Problem& p = *problem_;
  ResidualInput in{p.sx.data(),
                   p.sy.data(),
                   p.sz.data(),
                   p.tx.data(),
                   p.ty.data(),
                   p.tz.data(),
                   {},
                   {},
                   0,
                   0};
  std::copy(T.r, T.r + 9, in.r);
  std::copy(T.t, T.t + 3, in.t);
  const ResidualBounds bounds =
      residualBounds(T, p.radius, parameters_->inlier_distance);
  in.sure = bounds.sure;
  in.possible = bounds.possible;
  return in;
}

int
Stages::decideInliers(const PoseF& T,
                      std::size_t first_word,
                      std::size_t words,
                      std::uint64_t* sure,
                      const std::uint64_t* possible) const
{
  const float squared_limit =
      parameters_->inlier_distance * parameters_->inlier_distance;
  for (std::size_t w = 0; w < words; ++w)
    for (std::uint64_t open = possible[w] & ~sure[w]; open != 0; open &= open - 1) {
      const std::size_t bit = __builtin_ctzll(open);
      const PointPair pair = problem_->pair((first_word + w) * WORD_BITS + bit);
      if (squaredResidual(T, pair) < squared_limit)
        sure[w] |= std::uint64_t{1} << bit;
    }
  return static_cast<int>(kernels_.countBits(sure, words));
}

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
  const std::size_t words = problem_->padded_size / WORD_BITS;
  kernels_.residualTest(residualInput(T), 0, words, inliers, scratch);
  return decideInliers(T, 0, words, inliers, scratch);
}

void
Stages::verification()
{
  const std::size_t words = problem_->padded_size / WORD_BITS;
  pose_scores_.resize(poses_.size());
  const std::size_t tasks = (poses_.size() + POSES_A_TASK - 1) / POSES_A_TASK;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t) {
    const std::size_t begin = task * POSES_A_TASK;
    const std::size_t end = std::min(poses_.size(), begin + POSES_A_TASK);
    PoseF single[POSES_A_TASK];
    ResidualInput input[POSES_A_TASK];
    for (std::size_t i = begin; i < end; ++i) {
      pose_scores_[i] = pose_valid_[i] ? 0 : -1;
      if (!pose_valid_[i])
        continue;
      single[i - begin] = toSingle(poses_[i]);
      input[i - begin] = residualInput(single[i - begin]);
    }
    for (std::size_t word = 0; word < words; word += BLOCK_WORDS) {
      const std::size_t block = std::min(BLOCK_WORDS, words - word);
      for (std::size_t i = begin; i < end; ++i) {
        if (!pose_valid_[i])
          continue;
        std::uint64_t inliers[BLOCK_WORDS], possible[BLOCK_WORDS];
        const PoseF& T = single[i - begin];
        kernels_.residualTest(input[i - begin], word, block, inliers, possible);
        const int count = decideInliers(T, word, block, inliers, possible);
        pose_scores_[i] += scoreOf(T, word, block, inliers, count);
      }
    }
  });
}

} // namespace cpu
} // namespace pcl_flashreg
