// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Thousands of inputs that nobody would make on purpose, with parameters to match: no
// crash, and what comes back holds together.

#include "support/made_correspondences.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

using made::Random;

int
upTo(Random& random, int most)
{
  return static_cast<int>(random.next() % static_cast<unsigned>(most + 1));
}

/** \brief Zeros, extremes, denormals, NaN, infinities, and now and then a number. */
double
strangeNumber(Random& random)
{
  constexpr double STRANGE[] = {0.0,
                                -0.0,
                                1.0,
                                1e-310,
                                1e-20,
                                -1e-20,
                                1e14,
                                -1e14,
                                1e16,
                                1e30,
                                1e300,
                                std::numeric_limits<double>::quiet_NaN(),
                                std::numeric_limits<double>::infinity(),
                                -std::numeric_limits<double>::infinity()};
  const int i = upTo(random, 25);
  return i < 14 ? STRANGE[i] : random.uniform(-3, 3);
}

/** \brief One coordinate in one of several styles. */
double
coordinate(Random& random, int style)
{
  switch (style) {
  case 0:
    return strangeNumber(random);
  case 1:
    return upTo(random, 3); // a coarse grid: everything ties
  case 2:
    return random.uniform(-1e-7, 1e-7);
  case 3:
    return random.uniform(-1e9, 1e9);
  case 4:
    return 0.05 * upTo(random, 40);
  default:
    return random.uniform(-3, 3);
  }
}

Parameters
strangeParameters(Random& random)
{
  Parameters p;
  const double scales[] = {1e-12, 1e-3, 0.05, 1, 1e6, 1e12};
  p = Parameters::fromResolution(scales[upTo(random, 5)]);
  if (upTo(random, 2) == 0)
    p = Parameters{};
  if (upTo(random, 3) == 0)
    p.min_length_sum = 0;
  p.max_correspondences = 3 + upTo(random, 400);
  p.pivots = 1 + upTo(random, 300);
  p.cliques_per_pivot = 1 + upTo(random, 15);
  p.row_capacity = 1 + upTo(random, 60);
  p.pool_capacity = 1 + upTo(random, p.row_capacity - 1);
  p.second_order = static_cast<SecondOrder>(upTo(random, 2));
  p.score_metric = static_cast<ScoreMetric>(upTo(random, 2));
  p.refinement_iterations = upTo(random, 25);
  p.max_hypotheses = 1 + upTo(random, 10);
  return p;
}

void
expectSound(const Result& result, const Parameters& p, std::size_t n)
{
  EXPECT_EQ(result.correspondences_used + result.correspondences_dropped +
                result.correspondences_invalid,
            n);
  EXPECT_LE(result.correspondences_used,
            static_cast<std::size_t>(p.max_correspondences));
  ASSERT_TRUE(result.T_target_source.rotation.allFinite());
  ASSERT_TRUE(result.T_target_source.translation.allFinite());
  EXPECT_NEAR(result.T_target_source.rotation.determinant(), 1, 1e-6);
  EXPECT_TRUE(result.information.allFinite());
  EXPECT_TRUE(std::is_sorted(result.inliers.begin(), result.inliers.end()));
  EXPECT_LE(result.hypotheses.size(), static_cast<std::size_t>(p.max_hypotheses));
  for (const int i : result.inliers)
    EXPECT_LT(static_cast<std::size_t>(i), n);
  if (result.status == Status::Ok) {
    EXPECT_GE(result.inliers.size(), 3u);
    EXPECT_EQ(static_cast<std::size_t>(result.hypotheses.front().inlier_count),
              result.inliers.size());
  }
  else {
    EXPECT_FALSE(result.converged);
    EXPECT_TRUE(result.inliers.empty());
  }
}

TEST(EstimatorRobustness, HoldsTogetherOnStrangeInput)
{
  Random random(2026);
  Estimator reused(BackendKind::Auto, 2);
  for (int trial = 0; trial < 3000; ++trial) {
    SCOPED_TRACE(trial);
    const std::size_t n = trial % 10 == 0 ? upTo(random, 400) : upTo(random, 70);
    const int source_style = upTo(random, 5);
    const int target_style = upTo(random, 1) == 0 ? source_style : upTo(random, 5);
    std::vector<double> source, target;
    std::vector<float> ranks;
    for (std::size_t i = 0; i < 3 * n; ++i) {
      source.push_back(coordinate(random, source_style));
      // Often the same point again, so that cliques do form.
      target.push_back(upTo(random, 3) > 0 ? source.back()
                                           : coordinate(random, target_style));
    }
    for (std::size_t i = 0; i < n; ++i)
      ranks.push_back(static_cast<float>(strangeNumber(random)));
    const Parameters p = strangeParameters(random);
    const CorrespondenceView<double> view{
        source.data(), target.data(), n, upTo(random, 1) == 0 ? ranks.data() : nullptr};
    std::optional<RigidTransform> guess;
    if (upTo(random, 4) == 0)
      guess = RigidTransform{Eigen::Matrix3d::Identity(),
                             {strangeNumber(random), strangeNumber(random), 0}};
    const Result result = reused.estimate(view, p, guess);
    expectSound(result, p, n);
    if (HasFatalFailure())
      return;
  }
}

} // namespace
} // namespace pcl_flashreg
