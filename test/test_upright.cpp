// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Upright motions: what poses that tilt too much become, and what the estimator makes of
// knowing which way is up.

#include "math/isometry.h"
#include "math/triplet_alignment.h"
#include "math/upright.h"
#include "math/weighted_alignment.h"
#include "support/problems.h"

#include <pcl_flashreg/estimator.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cstring>

namespace pcl_flashreg {
namespace {

constexpr double RADIANS = 3.14159265358979323846 / 180;

Vec3
toVec3(const Eigen::Vector3d& p)
{
  return {p.x(), p.y(), p.z()};
}

Upright
uprightOf(const Eigen::Vector3d& source, const Eigen::Vector3d& target, double tilt)
{
  Upright upright;
  upright.required = true;
  upright.source_up = toVec3(source.normalized());
  upright.target_up = toVec3(target.normalized());
  upright.cosine = std::cos(tilt * RADIANS);
  upright.sine = std::sin(tilt * RADIANS);
  return upright;
}

/** \brief In degrees, from a sine: a cosine says nothing of small angles. */
double
tiltOf(const Eigen::Matrix3d& rotation,
       const Eigen::Vector3d& source,
       const Eigen::Vector3d& target)
{
  const Eigen::Vector3d up = rotation * source.normalized();
  const Eigen::Vector3d wanted = target.normalized();
  return std::atan2(up.cross(wanted).norm(), up.dot(wanted)) / RADIANS;
}

double
tiltOf(const Eigen::Matrix3d& rotation, const Parameters& parameters)
{
  const auto& s = parameters.source_gravity;
  const auto& t = parameters.target_gravity;
  return tiltOf(rotation, {s[0], s[1], s[2]}, {t[0], t[1], t[2]});
}

TEST(LimitTilt, GivesTheNextRotationThatTiltsAsMuchAsItMay)
{
  made::Random random(1);
  int turned_back = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Vector3d source = random.inCube(2) - Eigen::Vector3d::Ones();
    const Eigen::Vector3d target = random.inCube(2) - Eigen::Vector3d::Ones();
    const double most = random.uniform(0.01, 30);
    const Eigen::Isometry3d start = random.pose(1);
    Pose pose = toPose(start);
    const bool changed = limitTilt(uprightOf(source, target, most), pose.r);
    const Eigen::Matrix3d rotation = toIsometry(pose).linear();
    const double tilt = tiltOf(start.linear(), source, target);
    EXPECT_EQ(changed, tilt > most);
    turned_back += changed ? 1 : 0;
    EXPECT_NEAR(tiltOf(rotation, source, target), std::min(tilt, most), 1e-9);
    EXPECT_LT((rotation * rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-13);
    EXPECT_NEAR(made::rotationError(start.linear(), rotation),
                std::max(0.0, tilt - most),
                1e-5);
    EXPECT_FALSE(changed && limitTilt(uprightOf(source, target, most + 1e-9), pose.r))
        << "once is enough";
  }
  EXPECT_GT(turned_back, 900);
}

TEST(LimitTilt, TurnsOverWhatIsUpsideDown)
{
  for (const Eigen::Vector3d& up : {Eigen::Vector3d(0, 0, 1),
                                    Eigen::Vector3d(1, 0, 0),
                                    Eigen::Vector3d(1, -2, 3)}) {
    Pose pose = toPose(Eigen::Isometry3d::Identity());
    ASSERT_TRUE(limitTilt(uprightOf(up, -up, 5), pose.r));
    EXPECT_NEAR(tiltOf(toIsometry(pose).linear(), up, -up), 5, 1e-9);
  }
}

TEST(LimitTilt, LeavesWhatNobodyAsksItFor)
{
  Pose pose = toPose(made::Random(2).pose(1));
  const Pose before = pose;
  EXPECT_FALSE(limitTilt(Upright{}, pose.r));
  EXPECT_EQ(std::memcmp(&pose, &before, sizeof(Pose)), 0);
}

/** \brief Points whose best rotation tilts by more than it may: the tilt is the largest, and
 * no other heading fits better. */
TEST(UprightAlignment, HasTheBestHeading)
{
  made::Random random(3);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Isometry3d truth = random.pose(3);
    const Eigen::Vector3d up = random.inCube(2) - Eigen::Vector3d::Ones();
    const Eigen::Vector3d target_up = truth.linear() * random.pose(1).linear() * up;
    const Upright upright = uprightOf(up, target_up, 4);
    Vec3 s[3], t[3];
    AlignmentSums sums;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d p = random.inCube(2);
      s[i] = toVec3(p);
      t[i] = toVec3(truth * p + 0.01 * random.inCube(1));
      sums.add(1, s[i], t[i]);
    }
    Pose by_three, by_sums;
    ASSERT_TRUE(alignTriplet(s, t, upright, by_three));
    ASSERT_TRUE(alignWeighted(sums, upright, by_sums));
    const auto cost = [&](const Eigen::Isometry3d& T) {
      double sum = 0;
      for (int i = 0; i < 3; ++i)
        sum += (T * Eigen::Vector3d(s[i].x, s[i].y, s[i].z) -
                Eigen::Vector3d(t[i].x, t[i].y, t[i].z))
                   .squaredNorm();
      return sum;
    };
    const Eigen::Vector3d middle(
        sums.target.x / 3, sums.target.y / 3, sums.target.z / 3);
    for (const Pose& pose : {by_three, by_sums}) {
      const Eigen::Isometry3d T = toIsometry(pose);
      EXPECT_LT(tiltOf(T.linear(), up, target_up), 4 + 1e-9);
      for (const double degrees : {-90.0, -1.0, -0.01, 0.01, 1.0, 90.0, 180.0}) {
        const Eigen::AngleAxisd heading(degrees * RADIANS, target_up.normalized());
        EXPECT_LE(cost(T),
                  cost(Eigen::Translation3d(middle) * heading *
                       Eigen::Translation3d(-middle) * T) +
                      1e-12);
      }
    }
  }
}

TEST(UprightEstimator, FindsThePoseAmongOutliers)
{
  made::Recipe recipe;
  recipe.size = 2000;
  for (const double error : {0.0, 1.0, 2.9})
    for (const double inlier_ratio : {0.5, 0.02}) {
      recipe.inlier_ratio = inlier_ratio;
      const made::NamedProblem named =
          made::upright({"", made::make(recipe), {}}, error, 3);
      const Result result =
          Estimator().estimate(named.correspondences.view(), named.parameters);
      ASSERT_EQ(result.status, Status::Ok);
      EXPECT_TRUE(result.converged);
      EXPECT_LT(made::rotationError(result.T_target_source.rotation,
                                    named.correspondences.T_target_source.linear()),
                0.2);
      EXPECT_NEAR(
          tiltOf(result.T_target_source.rotation, named.parameters), error, 0.2);
    }
}

TEST(UprightEstimator, PrefersTheSetThatIsUpright)
{
  // Two thirds of the inliers follow a motion that tilts by 40 degrees more.
  made::Recipe recipe;
  recipe.size = 400;
  recipe.inlier_ratio = 0.5;
  made::Correspondences made = made::make(recipe);
  const Eigen::Isometry3d truth = made.T_target_source;
  const Eigen::Isometry3d tilted =
      truth * Eigen::AngleAxisd(40 * RADIANS, Eigen::Vector3d::UnitX());
  int inlier = 0;
  for (std::size_t i = 0; i < made.is_inlier.size(); ++i)
    if (made.is_inlier[i] && ++inlier % 3 != 0)
      Eigen::Map<Eigen::Vector3d>(&made.target[3 * i]) =
          tilted * Eigen::Map<const Eigen::Vector3d>(&made.source[3 * i]);
  made::NamedProblem named{"", made, {}};
  const auto errorTo = [&](const Eigen::Isometry3d& T) {
    const Result result =
        Estimator().estimate(named.correspondences.view(), named.parameters);
    return made::rotationError(result.T_target_source.rotation, T.linear());
  };
  EXPECT_LT(errorTo(tilted), 0.5);
  named.parameters.motion = MotionModel::Upright;
  const Eigen::Vector3f up = truth.linear().col(2).cast<float>();
  named.parameters.target_gravity = {up.x(), up.y(), up.z()};
  EXPECT_LT(errorTo(truth), 0.5);
}

TEST(UprightEstimator, DoesNotTrustWhatIsLeftWhereGravityIsWrong)
{
  for (const double inlier_ratio : {0.05, 0.5, 1.0}) {
    made::Recipe recipe;
    recipe.inlier_ratio = inlier_ratio;
    const made::NamedProblem named = made::upright({"", made::make(recipe), {}}, 20, 3);
    const Result result =
        Estimator().estimate(named.correspondences.view(), named.parameters);
    EXPECT_FALSE(result.converged) << inlier_ratio << ", " << result.confidence;
  }
}

TEST(UprightEstimator, NoHypothesisTiltsMoreThanItMay)
{
  for (const double error : {0.0, 4.0, 20.0, 180.0}) {
    made::NamedProblem named = made::upright(made::sized(500, 0.5), error, 2);
    named.parameters.max_hypotheses = 64;
    const Eigen::Isometry3d& truth = named.correspondences.T_target_source;
    const RigidTransform guess{truth.linear(), truth.translation()};
    for (const int rounds : {0, 20}) {
      named.parameters.refinement_iterations = rounds;
      const Result result =
          Estimator().estimate(named.correspondences.view(), named.parameters, guess);
      for (const Hypothesis& hypothesis : result.hypotheses)
        EXPECT_LT(tiltOf(hypothesis.T_target_source.rotation, named.parameters),
                  2 + 1e-9);
    }
  }
}

TEST(UprightEstimator, RigidMotionsKnowNoGravity)
{
  made::NamedProblem named = made::sized(500, 0.3);
  const Result before =
      Estimator().estimate(named.correspondences.view(), named.parameters);
  named = made::upright(named, 20, 1);
  named.parameters.motion = MotionModel::Rigid;
  const Result after =
      Estimator().estimate(named.correspondences.view(), named.parameters);
  EXPECT_EQ(before.T_target_source.rotation, after.T_target_source.rotation);
  EXPECT_EQ(before.confidence, after.confidence);
}

TEST(UprightEstimator, TakesGravityOfAnyLengthAndEitherSign)
{
  made::NamedProblem named = made::upright(made::sized(500, 0.3), 2, 3);
  const Result before =
      Estimator().estimate(named.correspondences.view(), named.parameters);
  for (auto* gravity :
       {&named.parameters.source_gravity, &named.parameters.target_gravity})
    for (float& component : *gravity)
      component *= -1024;
  const Result after =
      Estimator().estimate(named.correspondences.view(), named.parameters);
  EXPECT_EQ(before.inliers, after.inliers);
  EXPECT_EQ(before.T_target_source.rotation, after.T_target_source.rotation);
}

} // namespace
} // namespace pcl_flashreg
