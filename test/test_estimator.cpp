// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The method as a whole, on made correspondences.

#include "support/made_correspondences.h"

#include <pcl_flashreg/estimator.h>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

using made::Recipe;

RigidTransform
toRigid(const Eigen::Isometry3d& T)
{
  return {T.linear(), T.translation()};
}

/** \brief Largest displacement between two poses over points of a made cube. */
double
displacement(const RigidTransform& a, const Eigen::Isometry3d& b, double side)
{
  double largest = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d p(
        corner & 1 ? side : 0, corner & 2 ? side : 0, corner & 4 ? side : 0);
    largest = std::max(largest, (a.rotation * p + a.translation - b * p).norm());
  }
  return largest;
}

class OutlierRatios : public testing::TestWithParam<std::tuple<double, SecondOrder>> {};

TEST_P(OutlierRatios, FindsThePose)
{
  Recipe recipe;
  recipe.size = 2000;
  recipe.inlier_ratio = std::get<0>(GetParam());
  const made::Correspondences made = made::make(recipe);
  Parameters parameters;
  parameters.second_order = std::get<1>(GetParam());
  const Result result = Estimator().estimate(made.view(), parameters);
  ASSERT_EQ(result.status, Status::Ok);
  EXPECT_TRUE(result.converged) << "far beyond chance, and without a rival";
  EXPECT_LT(displacement(result.T_target_source, made.T_target_source, 3), 0.01);
  // All true inliers, and by chance some of the others.
  for (std::size_t i = 0; i < made.is_inlier.size(); ++i)
    if (made.is_inlier[i]) {
      EXPECT_TRUE(std::binary_search(
          result.inliers.begin(), result.inliers.end(), static_cast<int>(i)));
    }
  EXPECT_EQ(result.score, static_cast<double>(result.inliers.size()));
  EXPECT_EQ(result.correspondences_used, 2000u);
  EXPECT_EQ(result.second_order, parameters.second_order);
}

INSTANTIATE_TEST_SUITE_P(Outliers,
                         OutlierRatios,
                         testing::Combine(testing::Values(1.0, 0.5, 0.1, 0.05, 0.02),
                                          testing::Values(SecondOrder::Exact,
                                                          SecondOrder::Bounded)));

TEST(Estimator, IsNotFooledByNoiseAlone)
{
  for (int seed = 1; seed <= 20; ++seed) {
    Recipe recipe;
    recipe.size = 500;
    recipe.inlier_ratio = 0;
    recipe.seed = seed;
    const Result result = Estimator().estimate(made::make(recipe).view());
    EXPECT_FALSE(result.converged) << seed;
  }
}

TEST(Estimator, IsNotSureOfOneOfTwoMotions)
{
  // Half of the inliers moved one way, half another: neither answer is to be trusted.
  Recipe recipe;
  recipe.size = 400;
  recipe.inlier_ratio = 0.5;
  made::Correspondences made = made::make(recipe);
  int inlier = 0;
  for (std::size_t i = 0; i < made.is_inlier.size(); ++i)
    if (made.is_inlier[i] && ++inlier % 2 == 0)
      made.target[3 * i] += 2.0;
  const Result result = Estimator().estimate(made.view());
  ASSERT_EQ(result.status, Status::Ok);
  ASSERT_GE(result.hypotheses.size(), 2u);
  const Eigen::Vector3d between = result.hypotheses[0].T_target_source.translation -
                                  result.hypotheses[1].T_target_source.translation;
  EXPECT_NEAR(std::abs(between.x()), 2.0, 0.01);
  EXPECT_LT(result.distinctness, 1.5);
  EXPECT_FALSE(result.converged);
}

TEST(Estimator, TakesSmallInput)
{
  const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  Estimator estimator;
  for (std::size_t n = 0; n <= 2; ++n)
    EXPECT_EQ(estimator.estimate(CorrespondenceView<double>{points, points, n}).status,
              Status::TooFewCorrespondences);
  const Result three =
      estimator.estimate(CorrespondenceView<double>{points, points, 3});
  EXPECT_EQ(three.status, Status::Ok);
  EXPECT_TRUE(
      three.T_target_source.rotation.isApprox(Eigen::Matrix3d::Identity(), 1e-6));
  EXPECT_FALSE(three.converged) << "three correspondences always agree";
  EXPECT_EQ(estimator.estimate(CorrespondenceView<double>{}).status,
            Status::TooFewCorrespondences);
}

TEST(Estimator, SaysWhyThereIsNoPose)
{
  Estimator estimator;
  std::vector<double> same(300, 0.5);
  EXPECT_EQ(
      estimator.estimate(CorrespondenceView<double>{same.data(), same.data(), 100})
          .status,
      Status::NoClique);
  std::vector<double> line;
  for (int i = 0; i < 100; ++i)
    line.insert(line.end(), {0.1 * i, 0.2 * i, 0.3 * i});
  const Result collinear =
      estimator.estimate(CorrespondenceView<double>{line.data(), line.data(), 100});
  EXPECT_EQ(collinear.status, Status::Degenerate);
  EXPECT_FALSE(collinear.converged);
  EXPECT_TRUE(collinear.inliers.empty());
  EXPECT_TRUE(collinear.hypotheses.empty());
  EXPECT_TRUE(collinear.information.isZero());
  EXPECT_EQ(collinear.T_target_source.rotation, Eigen::Matrix3d::Identity());
}

TEST(Estimator, KeepsTheBestRankedAndSaysHowManyItDropped)
{
  Recipe recipe;
  recipe.size = 1000;
  recipe.inlier_ratio = 0.1;
  const made::Correspondences made = made::make(recipe);
  // Inliers rank first; one of them has no rank at all.
  std::vector<float> ranks;
  for (const char inlier : made.is_inlier)
    ranks.push_back(inlier ? 1.0f : 2.0f);
  const std::size_t first_inlier =
      std::find(made.is_inlier.begin(), made.is_inlier.end(), 1) -
      made.is_inlier.begin();
  ranks[first_inlier] = std::nanf("");
  const auto inliers =
      static_cast<int>(std::count(made.is_inlier.begin(), made.is_inlier.end(), 1));

  Parameters parameters;
  parameters.max_correspondences = inliers - 1;
  CorrespondenceView<double> view = made.view();
  view.ranks = ranks.data();
  const Result result = Estimator().estimate(view, parameters);
  EXPECT_EQ(result.correspondences_used, static_cast<std::size_t>(inliers - 1));
  EXPECT_EQ(result.correspondences_dropped, static_cast<std::size_t>(1001 - inliers));
  EXPECT_EQ(result.inliers.size(), static_cast<std::size_t>(inliers - 1));
  for (const int i : result.inliers)
    EXPECT_TRUE(made.is_inlier[i]) << i;

  // Without ranks, the first rows are the best.
  view.ranks = nullptr;
  for (const int i : Estimator().estimate(view, parameters).inliers)
    EXPECT_LT(i, parameters.max_correspondences);
}

TEST(Estimator, CountsRowsThatAreNotFinite)
{
  Recipe recipe;
  recipe.inlier_ratio = 0.3;
  made::Correspondences made = made::make(recipe);
  made.source[3 * 10] = std::nan("");
  made.target[3 * 20 + 2] = INFINITY;
  const Result result = Estimator().estimate(made.view());
  EXPECT_EQ(result.correspondences_invalid, 2u);
  EXPECT_EQ(result.correspondences_used, 998u);
  EXPECT_TRUE(result.converged);
  EXPECT_FALSE(std::binary_search(result.inliers.begin(), result.inliers.end(), 10));
}

TEST(Estimator, GeoReferencedCoordinatesGiveTheSamePose)
{
  Recipe recipe;
  recipe.inlier_ratio = 0.2;
  const made::Correspondences made = made::make(recipe);
  const Eigen::Vector3d shift(500000, 4000000, 300);
  made::Correspondences moved = made;
  for (std::size_t i = 0; i < made.source.size(); ++i) {
    moved.source[i] += shift[static_cast<int>(i % 3)];
    moved.target[i] += shift[static_cast<int>(i % 3)];
  }
  Estimator estimator;
  const RigidTransform near = estimator.estimate(made.view()).T_target_source;
  const RigidTransform far = estimator.estimate(moved.view()).T_target_source;
  // T_far p = T_near (p - shift) + shift, compared where the points are.
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p(
        made.source[3 * i], made.source[3 * i + 1], made.source[3 * i + 2]);
    const Eigen::Vector3d expected = near.rotation * p + near.translation + shift;
    EXPECT_LT((far.rotation * (p + shift) + far.translation - expected).norm(), 1e-3);
  }
}

TEST(Estimator, FloatAndDoubleAgree)
{
  Recipe recipe;
  recipe.inlier_ratio = 0.2;
  const made::Correspondences made = made::make(recipe);
  const std::vector<float> source(made.source.begin(), made.source.end());
  const std::vector<float> target(made.target.begin(), made.target.end());
  Estimator estimator;
  const Result single = estimator.estimate(
      CorrespondenceView<float>{source.data(), target.data(), source.size() / 3});
  EXPECT_LT(displacement(single.T_target_source, made.T_target_source, 3), 0.01);
}

TEST(Estimator, AGuessIsOneMoreHypothesis)
{
  // So few and so coarse inliers that no clique forms; the guess still counts them.
  Recipe recipe;
  recipe.size = 60;
  recipe.inlier_ratio = 1;
  recipe.noise = 0.03;
  const made::Correspondences made = made::make(recipe);
  Parameters parameters;
  parameters.length_tolerance = 1e-5f;
  Estimator estimator;
  EXPECT_NE(estimator.estimate(made.view(), parameters).status, Status::Ok);
  const Result guessed =
      estimator.estimate(made.view(), parameters, toRigid(made.T_target_source));
  ASSERT_EQ(guessed.status, Status::Ok);
  EXPECT_GT(guessed.inliers.size(), 50u);
  EXPECT_LT(displacement(guessed.T_target_source, made.T_target_source, 3), 0.05);

  // A wrong one, or one that is not finite, changes nothing.
  recipe.noise = 0.002;
  recipe.size = 500;
  const made::Correspondences clean = made::make(recipe);
  const Result without = estimator.estimate(clean.view());
  RigidTransform wrong;
  wrong.translation = {10, 20, 30};
  RigidTransform broken;
  broken.rotation(1, 1) = std::nan("");
  for (const RigidTransform& guess : {wrong, broken}) {
    const Result with = estimator.estimate(clean.view(), {}, guess);
    EXPECT_EQ(with.T_target_source.translation, without.T_target_source.translation);
    EXPECT_EQ(with.inliers, without.inliers);
  }
}

TEST(Estimator, InformationIsTheInverseCovariance)
{
  // Over many draws of the noise, the pose errors in units of their predicted spread
  // have a mean square of one.
  double squared = 0;
  constexpr int TRIALS = 200;
  for (int trial = 0; trial < TRIALS; ++trial) {
    Recipe recipe;
    recipe.size = 60;
    recipe.inlier_ratio = 1;
    recipe.noise = 0.004;
    recipe.seed = 100 + trial;
    const made::Correspondences made = made::make(recipe);
    Parameters parameters;
    parameters.length_tolerance = 0.05f;
    const Result result =
        Estimator(BackendKind::Cpu, 1).estimate(made.view(), parameters);
    ASSERT_EQ(result.status, Status::Ok);
    const Eigen::Isometry3d error =
        result.T_target_source.toIsometry() * made.T_target_source.inverse();
    const Eigen::AngleAxisd turn(error.linear());
    Eigen::Matrix<double, 6, 1> xi;
    xi << turn.angle() * turn.axis(), error.translation();
    squared += xi.dot(result.information * xi) / 6;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> eigen(
        result.information);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 0);
  }
  EXPECT_NEAR(squared / TRIALS, 1.0, 0.2);
}

TEST(Estimator, GivesTheSameResultAgainAndAgain)
{
  // One object over problems of many sizes, each compared with a fresh object's answer.
  Estimator reused(BackendKind::Auto, 2);
  for (const std::size_t size : {700, 50, 1300, 3, 200, 1300}) {
    Recipe recipe;
    recipe.size = size;
    recipe.inlier_ratio = 0.2;
    const made::Correspondences made = made::make(recipe);
    const Result fresh = Estimator(BackendKind::Auto, 1).estimate(made.view());
    for (int run = 0; run < 3; ++run) {
      const Result again = reused.estimate(made.view());
      EXPECT_EQ(again.T_target_source.rotation, fresh.T_target_source.rotation);
      EXPECT_EQ(again.T_target_source.translation, fresh.T_target_source.translation);
      EXPECT_EQ(again.inliers, fresh.inliers);
      EXPECT_EQ(again.distinctness, fresh.distinctness);
    }
  }
}

TEST(Estimator, StaysUsableAfterAnError)
{
  Recipe recipe;
  recipe.inlier_ratio = 0.3;
  const made::Correspondences made = made::make(recipe);
  Estimator estimator;
  Parameters bad;
  bad.inlier_distance = -1;
  EXPECT_THROW(estimator.estimate(made.view(), bad), std::invalid_argument);
  EXPECT_THROW(estimator.estimate(CorrespondenceView<float>{nullptr, nullptr, 5}),
               std::invalid_argument);
  EXPECT_TRUE(estimator.estimate(made.view()).converged);
  Estimator moved = std::move(estimator);
  EXPECT_TRUE(moved.estimate(made.view()).converged);
}

TEST(Estimator, AutoTurnsToBoundedOnDenseGraphs)
{
  Recipe recipe;
  recipe.size = 2500;
  recipe.inlier_ratio = 1;
  const Result dense = Estimator().estimate(made::make(recipe).view());
  EXPECT_EQ(dense.second_order, SecondOrder::Bounded);
  EXPECT_TRUE(dense.converged);
  recipe.inlier_ratio = 0.05;
  EXPECT_EQ(Estimator().estimate(made::make(recipe).view()).second_order,
            SecondOrder::Exact);
}

TEST(Estimator, AutoIsExactUpToAMeanDegreeOfEightTimesTheCapacity)
{
  // All agree with each other: each of n has n - 1 neighbours.
  Recipe recipe;
  recipe.inlier_ratio = 1;
  recipe.noise = 0;
  Parameters parameters;
  parameters.min_length_sum = 0;
  for (const int capacity : {1, 3}) {
    parameters.row_capacity = parameters.pool_capacity = capacity;
    recipe.size = 8 * static_cast<std::size_t>(capacity) + 1;
    EXPECT_EQ(Estimator().estimate(made::make(recipe).view(), parameters).second_order,
              SecondOrder::Exact);
    ++recipe.size;
    EXPECT_EQ(Estimator().estimate(made::make(recipe).view(), parameters).second_order,
              SecondOrder::Bounded);
  }
}

TEST(Estimator, TakesTwentyThousandInliers)
{
  Recipe recipe;
  recipe.size = 20000;
  recipe.inlier_ratio = 1;
  Parameters parameters;
  parameters.max_correspondences = 20000;
  const made::Correspondences made = made::make(recipe);
  const Result result = Estimator().estimate(made.view(), parameters);
  EXPECT_EQ(result.inliers.size(), 20000u);
  EXPECT_LT(displacement(result.T_target_source, made.T_target_source, 3), 0.001);
}

TEST(Estimator, CudaIsRefusedWhereItCannotBeHad)
{
  if (availableBackends().front() == "cuda")
    GTEST_SKIP() << "CUDA can be had on this machine";
  EXPECT_THROW(Estimator{BackendKind::Cuda}, BackendError);
}

TEST(Estimator, ReportsItsTimes)
{
  const made::Correspondences made = made::make({});
  const StageTimings t = Estimator().estimate(made.view()).timings_ms;
  double sum = 0;
  for (const Stage& stage : STAGES) {
    // It has no scans to look at again.
    if (stage.milliseconds == &StageTimings::second_look)
      EXPECT_EQ(t.*stage.milliseconds, 0);
    else
      EXPECT_GT(t.*stage.milliseconds, 0) << stage.name;
    sum += t.*stage.milliseconds;
  }
  EXPECT_LE(sum, t.total * (1 + 1e-9));
}

} // namespace
} // namespace pcl_flashreg
