// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 7: the best hypotheses that differ from one another are refined on their inliers.

#include "estimation/cpu/bits.h"
#include "estimation/cpu/stages.h"
#include "math/distinctness.h"
#include "math/weighted_alignment.h"

#include <algorithm>
#include <numeric>

namespace pcl_flashreg {
namespace cpu {

/** \brief Up to refinement_iterations rounds of alignment with weights
 * 1 / (1 + (d / inlier_distance)^2) over the current inliers, until their number no
 * longer changes. */
ScoredPose
Stages::refine(const Pose& start)
{
  const std::size_t words = problem_->padded_size / WORD_BITS;
  const double inverse_limit = 1.0 / parameters_->inlier_distance;
  std::uint64_t* inliers = inlier_words_.data();
  ScoredPose best;
  best.pose = start;
  int count = findInliers(toSingle(start), inliers, possible_words_.data());
  for (int round = 0; round < parameters_->refinement_iterations; ++round) {
    AlignmentSums lanes[ALIGNMENT_LANES];
    std::size_t lane = 0;
    for (std::size_t w = 0; w < words; ++w)
      for (std::uint64_t bits = inliers[w]; bits != 0; bits &= bits - 1) {
        const std::size_t i = w * WORD_BITS + __builtin_ctzll(bits);
        const Vec3 s = problem_->source(i), t = problem_->target(i);
        const Vec3 d = inverse_limit * (transform(best.pose, s) - t);
        lanes[lane++ % ALIGNMENT_LANES].add(1.0 / (1.0 + dot(d, d)), s, t);
      }
    Pose next;
    if (!alignWeighted(sumLanes(lanes), problem_->upright, next))
      break;
    best.pose = next;
    const int previous = count;
    count = findInliers(toSingle(next), inliers, possible_words_.data());
    if (count == previous)
      break;
  }
  best.inlier_count = count;
  best.score = scoreOf(toSingle(best.pose), 0, words, inliers, count);
  return best;
}

/** \brief Whether two of the three correspondences behind a hypothesis agree with one that
 * is listed already: then it is the same answer, however far off its pose may be. */
bool
Stages::explained(std::size_t i, std::size_t listed) const
{
  if (i >= cliques_.size())
    return false; // the caller's guess
  const std::size_t words = problem_->padded_size / WORD_BITS;
  const Clique& c = cliques_[i];
  for (std::size_t h = 0; h < listed; ++h) {
    const std::uint64_t* inliers = listed_inliers_.data() + h * words;
    const auto agrees = [&](std::uint32_t k) {
      return static_cast<int>((inliers[k / WORD_BITS] >> (k % WORD_BITS)) & 1);
    };
    if (agrees(c.u) + agrees(c.v) + agrees(c.w) >= 2)
      return true;
  }
  return false;
}

/** \brief Hypotheses by score, descending; of equal ones the first, which is in pivot
 * order, then clique order. */
std::vector<std::uint32_t>
Stages::rankHypotheses() const
{
  std::vector<std::uint32_t> order(poses_.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return pose_scores_[a] > pose_scores_[b];
  });
  return order;
}

void
Stages::refinement()
{
  const std::size_t words = problem_->padded_size / WORD_BITS;
  const std::size_t wanted = parameters_->max_hypotheses;
  inlier_words_.resize(words);
  possible_words_.resize(words);
  listed_inliers_.resize(wanted * words);

  listed_.clear();
  std::size_t refinements = 0;
  for (const std::uint32_t i : rankHypotheses()) {
    if (pose_scores_[i] < 0 || listed_.size() == wanted ||
        refinements == REFINEMENTS_A_HYPOTHESIS * wanted)
      break;
    if (explained(i, listed_.size()))
      continue;
    ++refinements;
    const ScoredPose refined = refine(poses_[i]);
    if (std::any_of(listed_.begin(), listed_.end(), [&](const ScoredPose& other) {
          return samePose(
              other.pose, refined.pose, problem_->radius, parameters_->inlier_distance);
        }))
      continue;
    std::copy(inlier_words_.begin(),
              inlier_words_.end(),
              listed_inliers_.begin() + listed_.size() * words);
    listed_.push_back(refined);
  }
}

} // namespace cpu
} // namespace pcl_flashreg
