// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What must not be trusted, whatever agrees with it.

#include "judgement/confidence.h"
#include "support/made_correspondences.h"
#include "support/made_scans.h"

#include <pcl_flashreg/pair_registration.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pcl_flashreg {
namespace {

struct Pairs {
  std::vector<double> source, target;

  void
  add(const Eigen::Vector3d& s, const Eigen::Vector3d& t)
  {
    source.insert(source.end(), s.data(), s.data() + 3);
    target.insert(target.end(), t.data(), t.data() + 3);
  }

  Result
  estimate(double resolution) const
  {
    const CorrespondenceView<double> view{
        source.data(), target.data(), source.size() / 3, nullptr};
    return Estimator(BackendKind::Cpu, 1)
        .estimate(view, Parameters::fromResolution(resolution));
  }
};

Eigen::Isometry3d
truth()
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::AngleAxisd(1.2, Eigen::Vector3d(1, 2, 3).normalized()));
  T.pretranslate(Eigen::Vector3d(1, 2, 3));
  return T;
}

Eigen::Vector3d
noise(made::Random& random, double deviation)
{
  const double x = random.normal(), y = random.normal(), z = random.normal();
  return deviation * Eigen::Vector3d(x, y, z);
}

/** \brief Right pairs along a line, or in a strip beside it. */
Pairs
alongALine(int count, double breadth, double deviation)
{
  made::Random random(5);
  Pairs pairs;
  const Eigen::Vector3d along = Eigen::Vector3d(1, 2, 3).normalized(),
                        across = along.unitOrthogonal();
  for (int i = 0; i < count; ++i) {
    const double x = random.uniform(-1, 1), y = random.uniform(-breadth, breadth);
    const Eigen::Vector3d s = x * along + y * across;
    pairs.add(s + noise(random, deviation), truth() * s + noise(random, deviation));
  }
  return pairs;
}

TEST(Verdict, DoesNotTrustWhatMayTurnAboutALine)
{
  for (const int count : {100, 1000, 5000})
    for (const double deviation : {0.001, 0.01}) {
      const Result result = alongALine(count, 0, deviation).estimate(0.05);
      EXPECT_LT(result.confidence, 0.1) << count << ' ' << deviation;
      EXPECT_LT(result.evidence.breadth, 0.5);
    }
  const Result held = alongALine(1000, 0.5, 0.001).estimate(0.05);
  EXPECT_TRUE(held.converged) << "a plane holds all of a rotation";
  EXPECT_LT(held.evidence.thickness, 0.1);
  EXPECT_GT(held.evidence.breadth, 4);
}

/** \brief Points of two cubes of 1 m, paired at random, of which some are right. */
Pairs
pairedAtRandom(int count, int right, std::uint64_t seed)
{
  made::Random random(seed);
  Pairs pairs;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d s = random.inCube(1), t = random.inCube(1);
    pairs.add(s, i < right ? Eigen::Vector3d(truth() * s) : t);
  }
  return pairs;
}

TEST(Verdict, DoesNotTrustChance)
{
  for (const int count : {20, 100, 500, 2000})
    for (const double resolution : {0.01, 0.05, 0.1, 0.2, 0.5})
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Result result = pairedAtRandom(count, 0, seed).estimate(resolution);
        EXPECT_FALSE(result.converged) << count << ' ' << resolution;
        if (result.status == Status::Ok) {
          EXPECT_GT(result.evidence.log_chance, 0) << count << ' ' << resolution;
        }
      }
  const Result result = pairedAtRandom(500, 60, 1).estimate(0.02);
  EXPECT_TRUE(result.converged) << result.confidence;
  EXPECT_LT(result.evidence.log_chance, -50);
}

/** \brief What a flipped axis leaves of a scan. */
std::vector<double>
mirrored(std::vector<double> xyz, std::size_t axis)
{
  for (std::size_t i = axis; i < xyz.size(); i += 3)
    xyz[i] = -xyz[i];
  return xyz;
}

TEST(Verdict, DoesNotTrustAMirroredCloud)
{
  const made::RoomScans room;
  PairRegistration registration(BackendKind::Cpu, 2);
  for (const double resolution : {0.07, 0.1})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::vector<double> flipped = mirrored(room.source, axis);
      Eigen::Vector3d viewpoint = room.source_viewpoint;
      viewpoint[static_cast<Eigen::Index>(axis)] *= -1;
      ScanInput<double> source = made::RoomScans::inputOf(flipped, viewpoint);
      PairOptions options;
      options.resolution = resolution;
      for (const bool known : {true, false}) {
        source.viewpoint_known = known;
        const Result result =
            registration.align(source, room.targetInput(), options).pose;
        EXPECT_FALSE(result.converged) << axis << ' ' << result.confidence;
        EXPECT_GT(result.evidence.mirrored, 2) << axis;
      }
    }
  PairOptions options;
  options.resolution = 0.1;
  const Result right =
      registration.align(room.sourceInput(), room.targetInput(), options).pose;
  EXPECT_TRUE(right.converged);
  EXPECT_LT(right.evidence.mirrored, -2);
}

TEST(Verdict, FindsTheReflectionOfCorrespondences)
{
  made::Random random(4);
  Pairs pairs;
  for (int i = 0; i < 300; ++i) {
    Eigen::Vector3d s = random.inCube(1);
    const Eigen::Vector3d t = random.inCube(1);
    pairs.add(s,
              i % 3 ? t
                    : Eigen::Vector3d(truth() * Eigen::Vector3d(-s.x(), s.y(), s.z())));
  }
  const Result result = pairs.estimate(0.02);
  EXPECT_FALSE(result.converged);
  EXPECT_GT(result.evidence.mirrored, 7) << "all hundred, but for what lies in a plane";
}

/** \brief Rectangles on a floor, seen from above: nothing but correspondences holds a pose. */
TEST(Verdict, DoesNotTrustAFlatCloud)
{
  made::Random random(8);
  std::vector<double> flat;
  for (int patch = 0; patch < 5; ++patch) {
    const double x0 = random.uniform(-1, 1), y0 = random.uniform(-1, 1);
    const double width = random.uniform(0.3, 1), height = random.uniform(0.3, 1);
    for (int i = 0; i < 400; ++i) {
      const double x = random.uniform(0, width), y = random.uniform(0, height);
      flat.insert(flat.end(), {x0 + x, y0 + y, 0});
    }
  }
  ScanInput<double> input;
  input.points.data = flat.data();
  input.points.size = flat.size() / 3;
  input.viewpoint = {0, 0, 3};
  for (const bool known : {true, false}) {
    input.viewpoint_known = known;
    PairOptions options;
    options.resolution = 0.05;
    Pairs all;
    for (std::size_t i = 0; i < flat.size(); i += 3)
      all.add(Eigen::Vector3d(&flat[i]), Eigen::Vector3d(&flat[i]));
    const CorrespondenceView<double> view{
        all.source.data(), all.target.data(), all.source.size() / 3, nullptr};
    const PairResult result =
        PairRegistration(BackendKind::Cpu, 1).align(input, input, view, options);
    EXPECT_EQ(result.pose.status, Status::Ok);
    EXPECT_TRUE(result.pose.evidence.has_clouds);
    EXPECT_LT(result.pose.evidence.stiffness, 1e-6);
    EXPECT_FALSE(result.pose.converged);
  }
}

/** \brief Two bodies of which one moved: the larger one has all the best pivots. */
TEST(Verdict, SeesASecondMotion)
{
  made::Random random(6);
  const Eigen::Isometry3d other = random.pose(3);
  Pairs pairs;
  for (int i = 0; i < 2000; ++i) {
    const Eigen::Vector3d s = random.inCube(2), t = random.inCube(2);
    pairs.add(s,
              i % 10 == 0                  ? truth() * s
              : i % 10 == 1 && i % 20 < 18 ? other * s
                                           : t);
  }
  for (int i = 0; i < 60; ++i) {
    const Eigen::Vector3d s = random.inCube(2);
    pairs.add(s, truth() * s);
  }
  const Result result = pairs.estimate(0.02);
  ASSERT_EQ(result.status, Status::Ok);
  ASSERT_GE(result.hypotheses.size(), 2u);
  EXPECT_TRUE(result.T_target_source.toIsometry().isApprox(truth(), 1e-2));
  EXPECT_TRUE(result.hypotheses[1].T_target_source.toIsometry().isApprox(other, 1e-2));
  EXPECT_GE(result.evidence.rival_inliers, 100);
  EXPECT_LT(result.distinctness, 3);
}

/** \brief The room twice, side by side: nobody can tell in which one the scan was taken. */
TEST(Verdict, IsNoMoreCertainThanOneOfTwoPlacesThatLookAlike)
{
  const made::RoomScans scans;
  std::vector<double> twice = scans.target;
  made::Random random(9);
  for (std::size_t i = 0; i < scans.target.size(); i += 3)
    made::RoomScans::append(twice,
                            Eigen::Vector3d(&scans.target[i]) +
                                Eigen::Vector3d(7.03, 0.02, 0) + noise(random, 0.003));
  ScanInput<double> target = scans.targetInput();
  target.points.data = twice.data();
  target.points.size = twice.size() / 3;
  target.viewpoint_known = false;
  PairOptions options;
  options.resolution = 0.1;
  for (const bool one_viewpoint : {true, false}) {
    ScanInput<double> source = scans.sourceInput();
    source.viewpoint_known = one_viewpoint;
    const PairResult result =
        PairRegistration(BackendKind::Cpu, 1).align(source, target, options);
    // Without any, the room whose normals are turned the wrong way has fewer matches.
    EXPECT_LE(result.pose.confidence, one_viewpoint ? 0.55 : 0.6);
    EXPECT_FALSE(result.pose.converged);
    EXPECT_GE(result.pose.hypotheses.size(), 2u);
    EXPECT_GT(result.pose.evidence.rivals, 0.8);
    // All normals of the map are turned to one place: half of its sides are wrong.
    EXPECT_TRUE(result.pose.evidence.has_sides);
  }
}

TEST(Verdict, DoesNotFailForAViewpointThatIsWrong)
{
  const made::RoomScans scans;
  ScanInput<double> source = scans.sourceInput(), target = scans.targetInput();
  source.viewpoint = scans.T_target_source.inverse() * Eigen::Vector3d(2.6, 0.3, 0.2);
  target.viewpoint = {1.0, 0.3, 0.9};
  PairOptions options;
  options.resolution = 0.05;
  const PairResult result =
      PairRegistration(BackendKind::Cpu, 1).align(source, target, options);
  EXPECT_LT(scans.error(result.pose.T_target_source), 0.05);
  EXPECT_TRUE(result.pose.converged) << result.pose.confidence;
}

TEST(Verdict, IsTheSameInBothDirections)
{
  const made::RoomScans scans;
  PairOptions options;
  options.resolution = 0.1;
  PairRegistration registration(BackendKind::Cpu, 1);
  const PairResult there =
      registration.align(scans.sourceInput(), scans.targetInput(), options);
  const PairResult back =
      registration.align(scans.targetInput(), scans.sourceInput(), options);
  EXPECT_TRUE(there.pose.converged);
  EXPECT_TRUE(back.pose.converged);
  EXPECT_NEAR(there.pose.confidence, back.pose.confidence, 0.02);
  EXPECT_NEAR(there.pose.evidence.stiffness, back.pose.evidence.stiffness, 0.005);
  EXPECT_NEAR(there.pose.evidence.hold, back.pose.evidence.hold, 0.3);
}

/** \brief The confidence that the coefficients of docs/method.md, in its order of
 * columns, give to evidence of the clouds. */
double
documentedConfidence(const Evidence& e, std::size_t column)
{
  const double matched = e.agreement.matched + 0.01;
  const double terms[] = {1,
                          std::log(e.inliers + 5),
                          std::log(matched),
                          std::log(e.agreement.contradicted / matched + 0.01),
                          e.agreement.residual,
                          e.lead,
                          std::log(e.stiffness + 0.001),
                          e.hold};
  constexpr double COEFFICIENTS[5][8] = {
      {-5.55, 0.93, 1.69, -1.69, -3.39, 0.65, 0.56, 1.76},
      {-4.53, 2.14, 1.20, -1.03, -3.52, 0.48, 1.15, 0.17},
      {-3.54, 1.96, 0, 0, -5.66, 1.19, 0.97, 2.03},
      {-2.48, 2.48, 1.43, -0.86, -4.51, 0, 1.33, 0},
      {-6.65, 2.57, 0, 0, -5.23, 2.08, 0.76, 1.55}};
  double log_odds = 0;
  for (std::size_t i = 0; i < 8; ++i)
    log_odds += COEFFICIENTS[column][i] * terms[i];
  const double held = 1 / (1 + std::exp(-8 * (e.hold - 0.2)));
  const double stiff = 1 / (1 + std::pow(0.004 / e.stiffness, 4));
  const double alone = 1 / (1 + std::pow(e.rivals, 1.5));
  return held * stiff * alone / (1 + std::exp(-log_odds));
}

TEST(Verdict, OfCloudsIsTheDocumentedOne)
{
  Evidence evidence;
  evidence.has_clouds = true;
  evidence.agreement = {0.3, 0.03, 0.4};
  evidence.inliers = 20;
  evidence.lead = 0.5;
  evidence.hold = 0.6;
  evidence.stiffness = 0.02;
  evidence.rivals = 0.3;
  evidence.mirrored = -20;
  for (const std::size_t column : {0, 1, 2, 3, 4}) {
    evidence.has_viewpoints = column < 3;
    evidence.one_viewpoint = column == 1 || column == 2;
    evidence.has_sides = column == 1 || column == 3;
    const double p = documentedConfidence(evidence, column);
    EXPECT_NEAR(confidenceOf(evidence), p, 1e-9) << column;
    Evidence again = evidence;
    again.second_look = true;
    EXPECT_NEAR(confidenceOf(again), p / (p + 2 * (1 - p)), 1e-9) << column;
    again.second_look = false;
    again.overruled_sides = true;
    EXPECT_NEAR(confidenceOf(again), p / (p + 3 * (1 - p)), 1e-9) << column;
  }
}

TEST(Verdict, OfCorrespondencesIsTheDocumentedOne)
{
  Evidence evidence;
  evidence.inliers = 30;
  evidence.inlier_ratio = 0.1;
  evidence.rival_inliers = 12;
  evidence.thickness = 4;
  evidence.breadth = 2;
  evidence.log_chance = -4;
  evidence.mirrored = -20;
  const double log_odds = -11.23 + 2.65 * std::log(31) + 1.52 * std::log(0.1001) +
                          2.88 * std::log(31.0 / 15) + 2.90 * std::log(5);
  const double needed =
      1 / (1 + std::pow(12.0 / 30, 4)) / (1 + std::pow(0.5, 4)) / (1 + std::exp(-4));
  EXPECT_NEAR(confidenceOf(evidence), needed / (1 + std::exp(-log_odds)), 1e-9);
}

/** \brief The confidence where one piece of the evidence is another. */
double
confidenceWith(Evidence evidence, double Evidence::*piece, double value)
{
  evidence.*piece = value;
  return confidenceOf(evidence);
}

TEST(Verdict, IsLimitedByEachOfItsNeeds)
{
  Evidence evidence;
  evidence.inliers = 500;
  evidence.inlier_ratio = 0.2;
  evidence.thickness = evidence.breadth = 20;
  evidence.log_chance = -300;
  evidence.mirrored = -5;
  const double p = confidenceOf(evidence);
  EXPECT_GT(p, 0.95);
  EXPECT_LE(confidenceWith(evidence, &Evidence::rival_inliers, 500), 0.5);
  EXPECT_LE(confidenceWith(evidence, &Evidence::breadth, 1), 0.5);
  EXPECT_LE(confidenceWith(evidence, &Evidence::log_chance, 0), 0.5);
  EXPECT_LE(confidenceWith(evidence, &Evidence::mirrored, 1.2), 0.5);

  evidence.has_clouds = true;
  evidence.agreement.matched = 0.9;
  evidence.lead = 5;
  evidence.hold = 2;
  evidence.stiffness = 0.05;
  for (const bool viewpoints : {true, false})
    for (const bool one : {true, false}) {
      evidence.has_viewpoints = viewpoints;
      evidence.one_viewpoint = one;
      evidence.has_sides = !viewpoints && one;
      EXPECT_GT(confidenceOf(evidence), 0.95);
      Evidence overruled = evidence;
      overruled.overruled_viewpoints = true;
      EXPECT_LT(confidenceOf(overruled), confidenceOf(evidence));
      EXPECT_LE(confidenceWith(evidence, &Evidence::stiffness, 0.004), 0.5);
      EXPECT_LE(confidenceWith(evidence, &Evidence::hold, 0.2), 0.5);
      EXPECT_LE(confidenceWith(evidence, &Evidence::rivals, 2), 1.0 / 3);
      EXPECT_EQ(confidenceWith(evidence, &Evidence::stiffness, 0), 0);
      EXPECT_LE(confidenceWith(evidence, &Evidence::mirrored, 1.2), 0.5);
    }
}

} // namespace
} // namespace pcl_flashreg
