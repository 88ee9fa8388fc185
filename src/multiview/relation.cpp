// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "multiview/relation.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

constexpr int RIVALS = 8;
/** \brief A pose that is less likely tells nothing. */
constexpr double LEAST_PROBABILITY = 1e-4;
/** \brief No pair is surer by itself: places repeat. */
constexpr double MOST_PROBABILITY = 0.9995;

/** \brief That a pose is right that is not the pair's best, if the best is wrong: a logistic
 * regression on what the pair knows of each of its poses, and by half too much. The best,
 * too, is at least as likely. */
double
probabilityOfRival(const Hypothesis& rival)
{
  if (!rival.agreement)
    return 0;
  const CloudAgreement& agreement = *rival.agreement;
  const double matched = agreement.matched + 0.01;
  const double z = -12.0 + 2.06 * std::log(rival.inlier_count + 5.0) +
                   1.79 * std::log(matched) -
                   1.37 * std::log(agreement.contradicted / matched + 0.01) -
                   0.82 * agreement.residual;
  return std::min(0.3, 0.5 / (1 + std::exp(-z)));
}

} // namespace

PairOptions
withRivals(PairOptions options)
{
  // Other pairs make up for what one look does not find.
  options.give_up_early = true;
  options.second_look = false;
  options.parameters.max_hypotheses =
      std::max(options.parameters.max_hypotheses, RIVALS);
  return options;
}

std::vector<RelativePose>
posesOf(const Result& result)
{
  std::vector<RelativePose> poses;
  if (result.hypotheses.empty())
    return poses;
  const double best = std::clamp(
      result.confidence,
      std::min(probabilityOfRival(result.hypotheses.front()), MOST_PROBABILITY),
      MOST_PROBABILITY);
  double sum = 0;
  for (std::size_t i = 0; i < result.hypotheses.size() && i < RIVALS; ++i) {
    const Hypothesis& hypothesis = result.hypotheses[i];
    const double probability =
        i == 0 ? best : (1 - best) * probabilityOfRival(hypothesis);
    if (probability < LEAST_PROBABILITY)
      continue;
    poses.push_back({hypothesis.T_target_source, probability, hypothesis.inlier_count});
    sum += probability;
  }
  if (sum > MOST_PROBABILITY)
    for (RelativePose& pose : poses)
      pose.probability *= MOST_PROBABILITY / sum;
  std::stable_sort(poses.begin(), poses.end(), [](const auto& a, const auto& b) {
    return a.probability > b.probability;
  });
  return poses;
}

} // namespace pcl_flashreg
