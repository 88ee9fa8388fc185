// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Laws of the alignments, and Eigen's SVD as their oracle.

#include "math/distinctness.h"
#include "math/isometry.h"
#include "math/triplet_alignment.h"
#include "math/weighted_alignment.h"
#include "support/made_correspondences.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <gtest/gtest.h>

namespace pcl_flashreg {
namespace {

using Points = std::vector<Eigen::Vector3d>;

Vec3
toVec3(const Eigen::Vector3d& p)
{
  return {p.x(), p.y(), p.z()};
}

/** \brief Kabsch by Eigen's SVD. */
Eigen::Isometry3d
kabsch(const Points& s, const Points& t, const std::vector<double>& w)
{
  double total = 0;
  Eigen::Vector3d cs(0, 0, 0), ct(0, 0, 0);
  for (std::size_t i = 0; i < s.size(); ++i) {
    total += w[i];
    cs += w[i] * s[i];
    ct += w[i] * t[i];
  }
  cs /= total;
  ct /= total;
  Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < s.size(); ++i)
    H += w[i] * (s[i] - cs) * (t[i] - ct).transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(
      H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d D = Eigen::Matrix3d::Identity();
  D(2, 2) = (svd.matrixV() * svd.matrixU().transpose()).determinant();
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = svd.matrixV() * D * svd.matrixU().transpose();
  T.translation() = ct - T.linear() * cs;
  return T;
}

double
cost(const Eigen::Isometry3d& T, const Points& s, const Points& t)
{
  double sum = 0;
  for (std::size_t i = 0; i < s.size(); ++i)
    sum += (T * s[i] - t[i]).squaredNorm();
  return sum;
}

bool
align(const Points& s, const Points& t, Pose& T)
{
  const Vec3 source[3] = {toVec3(s[0]), toVec3(s[1]), toVec3(s[2])};
  const Vec3 target[3] = {toVec3(t[0]), toVec3(t[1]), toVec3(t[2])};
  return alignTriplet(source, target, T);
}

TEST(AlignTriplet, RecoversThePose)
{
  made::Random random(1);
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Isometry3d truth = random.pose(10);
    Points s, t;
    for (int i = 0; i < 3; ++i) {
      s.push_back(random.inCube(3));
      t.push_back(truth * s.back());
    }
    Pose T;
    ASSERT_TRUE(align(s, t, T));
    EXPECT_LT((toIsometry(T).matrix() - truth.matrix()).norm(), 1e-9);
  }
}

TEST(AlignTriplet, IsTheLeastSquaresOptimum)
{
  made::Random random(2);
  for (int trial = 0; trial < 1000; ++trial) {
    const Eigen::Isometry3d truth = random.pose(10);
    Points s, t;
    for (int i = 0; i < 3; ++i) {
      s.push_back(random.inCube(3));
      // From slight noise to triangles that have nothing to do with each other,
      // mirrored ones among them.
      const double noise = trial % 2 == 0 ? 0.02 : 2.0;
      t.push_back(truth * s.back() + noise * random.inCube(1));
    }
    Pose T;
    if (!align(s, t, T))
      continue;
    const Eigen::Isometry3d oracle = kabsch(s, t, {1, 1, 1});
    EXPECT_NEAR(cost(toIsometry(T), s, t), cost(oracle, s, t), 1e-9);
    EXPECT_NEAR(toIsometry(T).linear().determinant(), 1, 1e-12);
    EXPECT_LT((toIsometry(T).linear().transpose() * toIsometry(T).linear() -
               Eigen::Matrix3d::Identity())
                  .norm(),
              1e-12);
  }
}

TEST(AlignTriplet, RefusesDegenerateTriangles)
{
  const Points good = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const Points collinear = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}};
  const Points coincident = {{1, 2, 3}, {1, 2, 3}, {4, 5, 6}};
  const Points not_finite = {{0, 0, 0}, {1, 0, 0}, {0, std::nan(""), 0}};
  Pose T;
  EXPECT_TRUE(align(good, good, T));
  for (const Points& bad : {collinear, coincident, not_finite}) {
    EXPECT_FALSE(align(good, bad, T));
    EXPECT_FALSE(align(bad, good, T));
  }
}

TEST(AlignWeighted, AgreesWithKabsch)
{
  made::Random random(3);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::Isometry3d truth = random.pose(5);
    Points s, t;
    std::vector<double> w;
    AlignmentSums sums;
    for (int i = 0; i < 3 + trial % 40; ++i) {
      s.push_back(random.inCube(3));
      t.push_back(truth * s.back() + 0.05 * random.inCube(1));
      w.push_back(random.uniform(0.1, 1));
      sums.add(w.back(), toVec3(s.back()), toVec3(t.back()));
    }
    Pose T;
    ASSERT_TRUE(alignWeighted(sums, T));
    EXPECT_LT((toIsometry(T).matrix() - kabsch(s, t, w).matrix()).norm(), 1e-7);
  }
}

/** \brief Points near a plane, a line, or a point far from the origin: whatever the data
 * determine must come out to the accuracy that they determine it with. */
TEST(AlignWeighted, AgreesWithKabschOnFlatAndThinClouds)
{
  made::Random random(6);
  for (const double thickness : {1.0, 1e-1, 1e-2}) {
    for (const double flatness : {1.0, 1e-3, 0.0})
      for (int trial = 0; trial < 50; ++trial) {
        const Eigen::Isometry3d truth = random.pose(5);
        const Eigen::Matrix3d frame = random.pose(1).linear();
        Points s, t;
        AlignmentSums sums;
        for (int i = 0; i < 30; ++i) {
          const Eigen::Vector3d p = random.inCube(3) - Eigen::Vector3d::Constant(1.5);
          s.push_back(frame * Eigen::Vector3d(p.x(),
                                              thickness * p.y(),
                                              thickness * flatness * p.z()));
          t.push_back(truth * s.back());
          sums.add(1, toVec3(s.back()), toVec3(t.back()));
        }
        Pose T;
        ASSERT_TRUE(alignWeighted(sums, T));
        EXPECT_LT((toIsometry(T).matrix() - truth.matrix()).norm(),
                  1e-12 / (thickness * thickness));
      }
  }
}

TEST(AlignWeighted, DoesNotDependOnTheUnit)
{
  made::Random random(7);
  const Eigen::Isometry3d truth = random.pose(1);
  for (const double unit : {1e-12, 1.0, 1e12}) {
    AlignmentSums sums;
    for (int i = 0; i < 10; ++i) {
      const Eigen::Vector3d s = random.inCube(3);
      sums.add(1, toVec3(unit * s), toVec3(unit * (truth.linear() * s)));
    }
    Pose T;
    ASSERT_TRUE(alignWeighted(sums, T));
    EXPECT_LT((toIsometry(T).linear() - truth.linear()).norm(), 1e-12);
  }
}

TEST(AlignWeighted, IgnoresPairsWithoutWeight)
{
  made::Random random(4);
  const Eigen::Isometry3d truth = random.pose(5);
  AlignmentSums sums;
  for (int i = 0; i < 10; ++i) {
    const Eigen::Vector3d s = random.inCube(3);
    sums.add(1, toVec3(s), toVec3(truth * s));
    sums.add(0, toVec3(random.inCube(3)), toVec3(random.inCube(3)));
  }
  Pose T;
  ASSERT_TRUE(alignWeighted(sums, T));
  EXPECT_LT((toIsometry(T).matrix() - truth.matrix()).norm(), 1e-9);
}

TEST(AlignWeighted, RefusesWhatDeterminesNoRotation)
{
  Pose T;
  EXPECT_FALSE(alignWeighted(AlignmentSums{}, T));
  AlignmentSums coincident, collinear, not_finite;
  for (int i = 0; i < 5; ++i) {
    coincident.add(1, {1, 2, 3}, {4, 5, 6});
    collinear.add(1, {1.0 * i, 0, 0}, {0, 1.0 * i, 0});
    not_finite.add(1, {1.0 * i, std::nan(""), 0}, {0, 1.0 * i, 0});
  }
  EXPECT_FALSE(alignWeighted(coincident, T));
  EXPECT_FALSE(alignWeighted(collinear, T));
  EXPECT_FALSE(alignWeighted(not_finite, T));
}

TEST(SamePose, TakesNoCornerMoreThanFiveInlierDistancesApart)
{
  const auto poseOf = [](double turn, double x) {
    const double c = std::cos(turn), s = std::sin(turn);
    return Pose{{c, -s, 0, s, c, 0, 0, 0, 1}, {x, 0, 0}};
  };
  const Pose start = poseOf(0, 0);
  EXPECT_TRUE(samePose(start, poseOf(0, 2.5), 0, 0.5f));
  EXPECT_FALSE(samePose(start, poseOf(0, 2.500001), 0, 0.5f));
  // A turn takes the corners of a cube in a sphere of 12 m this far.
  const double arm = std::sqrt(2.0 / 3) * 12;
  const double turn = 2 * std::asin(0.5 * 2.5 / arm);
  EXPECT_TRUE(samePose(start, poseOf(0.999 * turn, 0), 12, 0.5f));
  EXPECT_FALSE(samePose(start, poseOf(1.001 * turn, 0), 12, 0.5f));
  EXPECT_FALSE(samePose(start, poseOf(-0.9 * turn, 0.5), 12, 0.5f))
      << "one corner is enough";
}

TEST(SquaredResidual, IsTheDistanceSquared)
{
  made::Random random(5);
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Isometry3d truth = random.pose(2);
    Pose T;
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(T.r) = truth.linear();
    Eigen::Map<Eigen::Vector3d>(T.t) = truth.translation();
    const Eigen::Vector3f s = random.inCube(2).cast<float>(),
                          t = random.inCube(2).cast<float>();
    const double expected = (truth * s.cast<double>() - t.cast<double>()).squaredNorm();
    EXPECT_NEAR(
        squaredResidual(toSingle(T), {s.x(), s.y(), s.z(), t.x(), t.y(), t.z()}),
        expected,
        1e-5 * (1 + expected));
  }
}

TEST(Scores, AreOneAtNoResidualAndNoneAtTheLimit)
{
  EXPECT_EQ(maeScore(0, 0.1f), SCORE_UNIT);
  EXPECT_EQ(mseScore(0, 0.1f), SCORE_UNIT);
  EXPECT_NEAR(static_cast<double>(maeScore(0.05f * 0.05f, 0.1f)), 0.5 * SCORE_UNIT, 2);
  EXPECT_NEAR(static_cast<double>(mseScore(0.05f * 0.05f, 0.1f)), 0.25 * SCORE_UNIT, 2);
  EXPECT_GE(maeScore(std::nextafterf(0.01f, 0), 0.1f), 0);
}

} // namespace
} // namespace pcl_flashreg
