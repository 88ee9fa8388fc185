// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The clouds as judges of poses: each part against a plain oracle, then the whole.

#include "support/made_correspondences.h"

#include "judgement/cpu/agreement.h"
#include "judgement/cpu/plane_alignment.h"
#include "math/isometry.h"
#include "judgement/cpu/principal_motions.h"
#include "judgement/confidence.h"
#include "judgement/walk.h"

#include <pcl_flashreg/estimator.h>

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

constexpr double SPACING = 0.05;

/** \brief Points with normals, drawn with noise from a floor and two walls that meet in a
 * corner, as a sensor sees them from the middle. */
struct Corner {
  std::vector<double> xyz;
  std::vector<float> normals;
  Eigen::Vector3d viewpoint{1.2, 1.0, 1.0};

  explicit Corner(std::uint64_t seed, int walls = 3) : random(seed)
  {
    if (walls == 3) {
      wall({0, 0, 0}, {2.4, 0, 0}, {0, 2, 0}); // the floor
      wall({0, 0, 0}, {2.4, 0, 0}, {0, 0, 2});
    }
    wall({0, 0, 0}, {0, 2, 0}, {0, 0, 2});
  }

  void
  wall(const Eigen::Vector3d& corner,
       const Eigen::Vector3d& a,
       const Eigen::Vector3d& b)
  {
    Eigen::Vector3d normal = a.cross(b).normalized();
    if (normal.dot(viewpoint - corner) < 0)
      normal = -normal;
    for (double u = 0.5 * SPACING; u < a.norm(); u += SPACING)
      for (double v = 0.5 * SPACING; v < b.norm(); v += SPACING) {
        const double x = random.normal(), y = random.normal(), z = random.normal();
        const Eigen::Vector3d p = corner + u * a.normalized() + v * b.normalized() +
                                  0.05 * SPACING * Eigen::Vector3d(x, y, z);
        xyz.insert(xyz.end(), p.data(), p.data() + 3);
        const Eigen::Vector3f n = normal.cast<float>();
        normals.insert(normals.end(), n.data(), n.data() + 3);
      }
  }

  Corner
  moved(const Eigen::Isometry3d& T) const
  {
    Corner result = *this;
    for (std::size_t i = 0; i < xyz.size(); i += 3) {
      const Eigen::Vector3d p = T * Eigen::Vector3d(&xyz[i]);
      const Eigen::Vector3f n = T.linear().cast<float>() * Eigen::Vector3f(&normals[i]);
      std::copy_n(p.data(), 3, &result.xyz[i]);
      std::copy_n(n.data(), 3, &result.normals[i]);
    }
    result.viewpoint = T * viewpoint;
    return result;
  }

  CloudView<double>
  view(bool with_viewpoint = true) const
  {
    CloudView<double> view{xyz.data(), normals.data(), xyz.size() / 3, std::nullopt};
    view.normals_oriented = true;
    if (with_viewpoint)
      view.viewpoint = viewpoint;
    return view;
  }

  made::Random random;
};

Surface
surfaceOf(const CloudView<double>& view)
{
  Surface surface;
  surface.build(view, {0, 0, 0}, SPACING);
  return surface;
}

Eigen::Isometry3d
motion(double degrees, const Eigen::Vector3d& shift)
{
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180,
                                 Eigen::Vector3d(1, 2, 3).normalized())
                   .toRotationMatrix();
  T.translation() = shift;
  return T;
}

TEST(NearestPointGrid, AgreesWithExhaustiveSearchToWithinACell)
{
  made::Random random(3);
  const auto place = [&](double reach) {
    const double x = random.uniform(-reach, reach), y = random.uniform(-reach, reach),
                 z = random.uniform(-reach, reach);
    return Eigen::Vector3f(x, y, z);
  };
  std::vector<Eigen::Vector3f> places;
  for (int i = 0; i < 400; ++i)
    places.push_back(place(1));
  Array<Eigen::Vector3f> points;
  points = places;
  NearestPointGrid grid;
  grid.build(points, 0.1f);
  int found = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3f query = place(1.5);
    float nearest = INFINITY;
    for (const Eigen::Vector3f& point : points)
      nearest = std::min(nearest, (point - query).norm());
    const int answer = grid.find(query);
    found += answer >= 0;
    if (answer >= 0) {
      EXPECT_LE((points[answer] - query).norm(), nearest + 0.1f * std::sqrt(3.0f));
    }
    else {
      EXPECT_EQ(answer, -1);
      EXPECT_GT(nearest, 0.14f);
    }
  }
  EXPECT_GT(found, 1000);
  EXPECT_EQ(grid.find({1e30f, 0, 0}), -1);
  EXPECT_EQ(grid.find({NAN, 0, 0}), -1);
}

TEST(FreeSpace, IsWhatLiesInFrontOfTheSurface)
{
  std::vector<Eigen::Vector3f> places;
  for (float x = -1; x <= 1; x += 0.05f)
    for (float y = -1; y <= 1; y += 0.05f)
      places.emplace_back(x, y, 2);
  Array<Eigen::Vector3f> wall;
  wall = places;
  FreeSpace space;
  EXPECT_FALSE(space.known());
  EXPECT_FALSE(space.contains({0, 0, 1}, 0.15f));
  space.build(wall, {0, 0, 0}, 0.05f);
  EXPECT_TRUE(space.known());
  EXPECT_TRUE(space.contains({0.1f, 0.1f, 1}, 0.15f));
  EXPECT_TRUE(space.contains({0, 0, 1.7f}, 0.15f));
  EXPECT_FALSE(space.contains({0, 0, 1.95f}, 0.15f)) << "within the margin";
  EXPECT_FALSE(space.contains({0, 0, 3}, 0.15f)) << "behind the wall";
  EXPECT_FALSE(space.contains({0, 0, -1}, 0.15f)) << "behind the sensor";
  EXPECT_FALSE(space.contains({3, 0, 1}, 0.15f)) << "nothing was seen there";
  for (const float far : {1e38f, INFINITY, -INFINITY, NAN}) {
    EXPECT_FALSE(space.contains({far, far, far}, 0.15f)) << far;
    EXPECT_FALSE(space.contains({0, far, 1}, 0.15f)) << far;
  }
  space.clear();
  EXPECT_FALSE(space.contains({0, 0, 1}, 0.15f));
  space.build(wall, {0, INFINITY, 0}, 0.05f);
  EXPECT_FALSE(space.known());
}

TEST(CloudAgreement, TellsAMatchFromAContradiction)
{
  const Corner corner(1), other(2);
  const Surface source = surfaceOf(corner.view()), target = surfaceOf(other.view());
  const SurfacePair clouds{source, target, SPACING};
  const Look look(clouds, 1000, 1.5f, 3);
  const CloudAgreement same = look(toPose(Eigen::Isometry3d::Identity()));
  EXPECT_GT(same.matched, 0.9);
  EXPECT_EQ(same.contradicted, 0);
  EXPECT_GT(same.residual, 0);
  EXPECT_LT(same.residual, 0.3);

  // Half a metre along x: floor and one wall still match, the other wall hangs in the
  // air that the sensor looked through.
  const Pose slid = toPose(motion(0, {0.5, 0, 0}));
  const CloudAgreement sliding = look(slid);
  EXPECT_GT(sliding.matched, 0.4);
  EXPECT_GT(sliding.contradicted, 0.05);

  const Surface blind = surfaceOf(corner.view(false));
  const Surface blind_too = surfaceOf(other.view(false));
  const SurfacePair unseen{blind, blind_too, SPACING};
  EXPECT_EQ(Look(unseen, 1000, 1.5f, 3)(slid).contradicted, 0);

  // Their normals alone tell that just before a wall there is nothing ...
  const SurfacePair sides{blind, blind_too, SPACING, Belief::Sides};
  const Look by_sides(sides, 1000, 1.5f, 3);
  EXPECT_EQ(by_sides(toPose(Eigen::Isometry3d::Identity())).contradicted, 0);
  EXPECT_GT(by_sides(toPose(motion(0, {0.2, 0, 0}))).contradicted, 0.05);
  EXPECT_LT(by_sides(toPose(motion(0, {-20, 0, 0}))).contradicted, 0.01) << "far away";

  // ... as those of the one cloud do whose viewpoint is not known, beside the other's ...
  const SurfacePair one_sees{blind, target, SPACING, Belief::Sides};
  const Look from_one(one_sees, 1000, 1.5f, 3);
  // Its wall would be behind the other one's, out of sight, which is before it.
  const Pose behind = toPose(motion(0, {-0.2, 0, 0}));
  EXPECT_GT(from_one(toPose(Eigen::Isometry3d::Identity())).matched, 0.9);
  EXPECT_GT(from_one(behind).contradicted, 0.05);
  CloudView<double> of_any_sign = corner.view(false);
  of_any_sign.normals_oriented = false;
  const Surface unsigned_blind = surfaceOf(of_any_sign);
  const SurfacePair one_sees_alone{unsigned_blind, target, SPACING, Belief::Sides};
  EXPECT_EQ(Look(one_sees_alone, 1000, 1.5f, 3)(behind).contradicted, 0);
  // ... unless it is so large that no one place can have seen it.
  Corner many(3);
  for (int copy = 0; copy < 3; ++copy) {
    many.xyz.insert(many.xyz.end(), corner.xyz.begin(), corner.xyz.end());
    many.normals.insert(
        many.normals.end(), corner.normals.begin(), corner.normals.end());
  }
  const Surface map = surfaceOf(many.view(false));
  EXPECT_TRUE(one_sees.hasSides());
  EXPECT_FALSE((SurfacePair{map, target, SPACING, Belief::Sides}.hasSides()));

  // Turned over, the floor lies on itself, but faces the other way.
  Eigen::Isometry3d over = Eigen::Isometry3d::Identity();
  over.linear() = Eigen::AngleAxisd(3.14159265358979323846, Eigen::Vector3d::UnitX())
                      .toRotationMatrix();
  over.translation().y() = 2;
  EXPECT_LT(look(toPose(over)).matched, 0.1);
  // They tell, too, which side of it was seen; nothing does if nothing is believed.
  EXPECT_GT(by_sides(toPose(over)).contradicted, 0.2);
  const SurfacePair nothing{blind, blind_too, SPACING, Belief::Nothing};
  const CloudAgreement turned = Look(nothing, 1000, 1.5f, 3)(toPose(over));
  EXPECT_GT(turned.matched, 0.2);
  EXPECT_EQ(turned.contradicted, 0);
}

TEST(PlaneAlignment, MovesAPoseOntoTheSurface)
{
  const Corner corner(1), other(2);
  const Surface source = surfaceOf(corner.view()), target = surfaceOf(other.view());
  const SurfacePair clouds{source, target, SPACING};
  const Pose moved = moveOntoTarget(clouds, toPose(motion(1.5, {0.02, -0.03, 0.025})));
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(2.4, 2, 2)}) {
    const Vec3 at = transform(moved, {p.x(), p.y(), p.z()});
    EXPECT_LT((Eigen::Vector3d(at.x, at.y, at.z) - p).norm(), 0.2 * SPACING);
  }
}

TEST(PrincipalMotions, AWallAloneHoldsNothing)
{
  const Surface corner = surfaceOf(Corner(1).view());
  const Surface wall = surfaceOf(Corner(1, 1).view());
  const Pose identity = toPose(Eigen::Isometry3d::Identity());
  EXPECT_GT(principalMotions({corner, corner, SPACING}, identity).front().stiffness,
            0.02);
  const std::vector<Motion> motions = principalMotions({wall, wall, SPACING}, identity);
  ASSERT_EQ(motions.size(), 6u);
  EXPECT_LT(motions[2].stiffness, 1e-6) << "two shifts and a turn are free";
  EXPECT_GT(motions[3].stiffness, 0.05);
}

TEST(PrincipalMotions, MoveAlongAScrew)
{
  Motion motion;
  motion.middle = {1, 2, 3};
  motion.turn = {0, 0, 0.5};
  motion.shift = {0, 0, 0.25};
  const double pi = 3.14159265358979323846;
  const Pose moved = moveAlong(toPose(Eigen::Isometry3d::Identity()), motion, 2 * pi);
  const Vec3 at = transform(moved, {2, 2, 3});
  EXPECT_NEAR(at.x, 0, 1e-12) << "half a turn about the middle";
  EXPECT_NEAR(at.y, 2, 1e-12);
  EXPECT_NEAR(at.z, 3 + pi / 2, 1e-12);
  const Vec3 back = transform(moveAlong(moved, motion, -2 * pi), {2, 2, 3});
  EXPECT_NEAR(back.x, 2, 1e-12);
  EXPECT_NEAR(back.z, 3, 1e-12);
}

TEST(Walk, IsAtAnotherPoseFromNineSpacingsOn)
{
  ThreadPool pool(2);
  const Pose identity = toPose(Eigen::Isometry3d::Identity());
  for (const int walls : {1, 3}) {
    const Surface source = surfaceOf(Corner(1, walls).view());
    const Surface target = surfaceOf(Corner(2, walls).view());
    const std::vector<Walk> walks = walkOff({source, target, SPACING}, identity, pool);
    ASSERT_FALSE(walks.empty());
    for (const Walk& walk : walks) {
      EXPECT_NEAR(walk.far, 9 * SPACING, 1e-4 * SPACING);
      EXPECT_LE(walk.stops.front().way, -walk.far);
      EXPECT_GE(walk.stops.back().way, walk.far);
      // A wall alone says nearly the same from elsewhere, a corner does not.
      EXPECT_EQ(walk.rise() > -0.5, walls == 1) << walk.rise();
    }
  }
}

/** \brief A corner seen twice, and correspondences of which more agree with a wrong motion
 * than with the right one. */
struct Deceived {
  Corner target{2};
  Eigen::Isometry3d T_target_source = motion(40, {1, -2, 0.5});
  Corner source = Corner(1).moved(T_target_source.inverse());
  std::vector<double> source_xyz, target_xyz;

  Deceived()
  {
    made::Random random(7);
    add(40, T_target_source, random);
    add(60, motion(0, {0.6, 0, 0}) * T_target_source, random);
  }

  /** \brief Correspondences of points of the source that agree with a motion. */
  void
  add(int count, const Eigen::Isometry3d& T, made::Random& random)
  {
    for (int i = 0; i < count; ++i) {
      const std::size_t row = static_cast<std::size_t>(
          random.uniform(0, static_cast<double>(source.xyz.size() / 3)));
      const Eigen::Vector3d s(&source.xyz[3 * row]);
      const Eigen::Vector3d t = T * s;
      source_xyz.insert(source_xyz.end(), s.data(), s.data() + 3);
      target_xyz.insert(target_xyz.end(), t.data(), t.data() + 3);
    }
  }

  CorrespondenceView<double>
  view() const
  {
    return {source_xyz.data(), target_xyz.data(), source_xyz.size() / 3, nullptr};
  }

  CloudPairView<double>
  clouds(bool with_viewpoints = true) const
  {
    return {source.view(with_viewpoints), target.view(with_viewpoints), SPACING};
  }

  double
  error(const Result& result) const
  {
    return (result.T_target_source.toIsometry() * source.viewpoint - target.viewpoint)
        .norm();
  }
};

TEST(Estimator, LetsTheCloudsChoose)
{
  const Deceived deceived;
  const Result blind = Estimator().estimate(deceived.view());
  EXPECT_NEAR(deceived.error(blind), 0.6, 0.05) << "the test needs a wrong majority";
  EXPECT_FALSE(blind.evidence.has_clouds);
  EXPECT_FALSE(blind.hypotheses.front().agreement);

  for (const bool viewpoints : {true, false}) {
    const auto clouds = deceived.clouds(viewpoints);
    const Result result =
        Estimator().estimate(deceived.view(), {}, std::nullopt, &clouds);
    ASSERT_EQ(result.status, Status::Ok);
    EXPECT_LT(deceived.error(result), 0.3 * SPACING) << viewpoints;
    EXPECT_EQ(result.inliers.size(), 40u);
    EXPECT_EQ(result.score, 40);
    EXPECT_TRUE(result.evidence.has_clouds);
    EXPECT_EQ(result.evidence.inliers, 40);
    EXPECT_EQ(result.evidence.rival_inliers, 60);
    ASSERT_TRUE(result.hypotheses.front().agreement);
    EXPECT_GT(result.hypotheses.front().agreement->matched, 0.85);
    EXPECT_GT(result.evidence.lead, 0);
    EXPECT_EQ(result.confidence, confidenceOf(result.evidence));
    EXPECT_EQ(result.converged, result.confidence >= Parameters().min_confidence);
  }
}

/** \brief Maps weigh such poses against what other pairs say, and need all that speaks
 * against each. */
TEST(Estimator, StatesWhatContradictsPosesByViewpointsThatItOverrules)
{
  Deceived deceived;
  for (float& value : deceived.source.normals)
    value = -value;
  const auto clouds = deceived.clouds();
  Parameters parameters;
  parameters.max_hypotheses = 20;
  const Result result =
      Estimator().estimate(deceived.view(), parameters, std::nullopt, &clouds);
  ASSERT_TRUE(result.evidence.overruled_viewpoints);
  EXPECT_LT(deceived.error(result), 0.3 * SPACING);
  double most = 0;
  for (const Hypothesis& hypothesis : result.hypotheses)
    most = std::max(most, hypothesis.agreement->contradicted);
  EXPECT_GT(most, 0.05);
}

/** \brief Thirty wrong motions have more correspondences than the right one. */
TEST(Estimator, AsksTheCloudsAboutEveryHypothesis)
{
  Deceived deceived;
  deceived.source_xyz.clear();
  deceived.target_xyz.clear();
  made::Random random(8);
  deceived.add(8, deceived.T_target_source, random);
  for (int wrong = 0; wrong < 30; ++wrong)
    deceived.add(12, random.pose(2), random);
  EXPECT_GT(deceived.error(Estimator().estimate(deceived.view())), 0.5)
      << "the test needs a wrong majority";
  const auto clouds = deceived.clouds();
  const Result result = Estimator().estimate(deceived.view(), {}, {}, &clouds);
  EXPECT_LT(deceived.error(result), 0.3 * SPACING);
  EXPECT_EQ(result.inliers.size(), 8u);
}

TEST(Estimator, SaysTheSameOfCloudsOnAnyNumberOfThreads)
{
  const Deceived deceived;
  const auto clouds = deceived.clouds();
  const Result one =
      Estimator(BackendKind::Cpu, 1).estimate(deceived.view(), {}, {}, &clouds);
  const Result four =
      Estimator(BackendKind::Cpu, 4).estimate(deceived.view(), {}, {}, &clouds);
  EXPECT_EQ(one.T_target_source.toMatrix<double>(),
            four.T_target_source.toMatrix<double>());
  EXPECT_EQ(one.confidence, four.confidence);
  EXPECT_EQ(one.inliers, four.inliers);
  EXPECT_EQ(one.hypotheses.size(), four.hypotheses.size());
}

TEST(Estimator, WorksFarFromTheOriginWithClouds)
{
  const Deceived deceived;
  Deceived far = deceived;
  const Eigen::Vector3d away(5e5, 4e6, 100);
  for (auto* xyz : {&far.target.xyz, &far.target_xyz})
    for (std::size_t i = 0; i < xyz->size(); ++i)
      (*xyz)[i] += away[i % 3];
  far.target.viewpoint += away;
  const auto clouds = far.clouds();
  const Result result = Estimator().estimate(far.view(), {}, {}, &clouds);
  EXPECT_LT(far.error(result), 0.3 * SPACING);
}

TEST(Estimator, ManagesWithoutAnyPointInTheClouds)
{
  const Deceived deceived;
  CloudPairView<double> clouds;
  clouds.spacing = SPACING;
  const Result result = Estimator().estimate(deceived.view(), {}, {}, &clouds);
  EXPECT_EQ(result.status, Status::Ok);
  EXPECT_FALSE(result.evidence.has_clouds);
  EXPECT_EQ(result.inliers.size(), 60u);

  std::vector<float> normals(deceived.source.normals.size(), NAN);
  clouds = deceived.clouds();
  clouds.source.normals = normals.data();
  EXPECT_FALSE(
      Estimator().estimate(deceived.view(), {}, {}, &clouds).evidence.has_clouds);
}

TEST(Estimator, TakesAViewpointThatOverflows)
{
  Deceived deceived;
  CloudPairView<double> clouds = deceived.clouds();
  clouds.source.viewpoint = Eigen::Vector3d(1e300, 0, -1e300);
  const Result result = Estimator().estimate(deceived.view(), {}, {}, &clouds);
  EXPECT_LT(deceived.error(result), 0.3 * SPACING);
  EXPECT_TRUE(result.evidence.one_viewpoint);
}

TEST(Estimator, RefusesCloudsThatCannotBe)
{
  const Deceived deceived;
  CloudPairView<double> clouds = deceived.clouds();
  clouds.spacing = 0;
  EXPECT_THROW(Estimator().estimate(deceived.view(), {}, {}, &clouds),
               std::invalid_argument);
  clouds = deceived.clouds();
  clouds.target.normals = nullptr;
  EXPECT_THROW(Estimator().estimate(deceived.view(), {}, {}, &clouds),
               std::invalid_argument);
}

TEST(Confidence, GrowsWithWhatSpeaksForAPose)
{
  Evidence evidence;
  evidence.inliers = 60;
  evidence.inlier_ratio = 0.02;
  evidence.rival_inliers = 30;
  evidence.thickness = 8;
  evidence.breadth = 16;
  evidence.log_chance = -100;
  evidence.mirrored = -5;
  Evidence better = evidence;
  better.inliers = 120;
  EXPECT_GT(confidenceOf(better), confidenceOf(evidence));
  better = evidence;
  better.thickness = 16;
  EXPECT_GT(confidenceOf(better), confidenceOf(evidence));
  better.inliers = better.rival_inliers = 1000;
  better.inlier_ratio = 0.5;
  EXPECT_LE(confidenceOf(better), 0.5) << "there is another pose as good";

  evidence.has_clouds = evidence.has_viewpoints = true;
  evidence.agreement = {0.3, 0.01, 0.3};
  evidence.hold = 1;
  evidence.lead = 1;
  evidence.stiffness = 0.02;
  const double p = confidenceOf(evidence);
  better = evidence;
  better.agreement.contradicted = 0.1;
  EXPECT_LT(confidenceOf(better), p);
  better = evidence;
  better.lead = 2;
  EXPECT_GT(confidenceOf(better), p);
  better = evidence;
  better.stiffness = 0.002;
  EXPECT_LT(confidenceOf(better), p);
  better = evidence;
  better.tilted = 5;
  EXPECT_LT(confidenceOf(better), 0.1 * p) << "gravity is wrong";
  EXPECT_GT(p, 0);
  EXPECT_LT(p, 1);
}

} // namespace
} // namespace pcl_flashreg
