// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Places that do not say where a scan was taken: nothing is trusted there, and the result names
// what is not known.

#include "estimation/information.h"
#include "support/made_places.h"

#include <pcl_flashreg/pair_registration.h>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pcl_flashreg {
namespace {

Result
align(const made::Views& views, double resolution, bool viewpoints)
{
  ScanInput<double> source = views.sourceInput(), target = views.targetInput();
  source.viewpoint_known = target.viewpoint_known = viewpoints;
  PairOptions options;
  options.resolution = resolution;
  return PairRegistration(BackendKind::Cpu, 2).align(source, target, options).pose;
}

/** \brief What views of a place leave free, of several seeds, with viewpoints and without; no
 * pose is trusted there. */
std::vector<FreeMotion>
freeMotionsOf(made::Views (*place)(std::uint64_t), double resolution)
{
  std::vector<FreeMotion> motions;
  for (const std::uint64_t seed : {1, 2})
    for (const bool viewpoints : {true, false}) {
      const Result result = align(place(seed), resolution, viewpoints);
      EXPECT_EQ(result.status, Status::Ok);
      EXPECT_FALSE(result.converged) << result.confidence;
      EXPECT_FALSE(result.free_motions.empty());
      if (!result.free_motions.empty())
        motions.push_back(result.free_motions.front());
    }
  return motions;
}

TEST(FreeMotion, SlidesAlongACorridor)
{
  for (const FreeMotion& free : freeMotionsOf(made::corridor, 0.15)) {
    EXPECT_EQ(free.kind, FreeMotion::Kind::Slide);
    EXPECT_GT(std::abs(free.direction.x()), 0.99);
    EXPECT_GT(free.forward + free.backward, 2);
    EXPECT_LT(free.forward + free.backward, 20) << "the corridor is seen for 18 m";
  }
}

TEST(FreeMotion, TurnsABottle)
{
  for (const FreeMotion& free : freeMotionsOf(made::bottle, 0.004)) {
    EXPECT_EQ(free.kind, FreeMotion::Kind::Turn);
    EXPECT_GT(std::abs(free.direction.z()), 0.99);
    EXPECT_LT(free.point.head<2>().norm(), 0.008) << "the axis of the bottle";
    EXPECT_GT(free.forward + free.backward, 1);
  }
}

TEST(FreeMotion, IsNothingThatTheInformationMatrixClaimsToKnow)
{
  const Result result = align(made::corridor(1), 0.15, true);
  ASSERT_FALSE(result.free_motions.empty());
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(
      result.information);
  EXPECT_LT(std::abs(solver.eigenvalues()[0]), 1e-6 * solver.eigenvalues()[5]);
  const Eigen::Matrix3d of_shifts = result.information.bottomRightCorner(3, 3);
  EXPECT_LT(of_shifts(0, 0), 1e-2 * of_shifts.trace()) << "along the corridor";
}

TEST(FreeMotion, ForgetsWhatIsClaimedAlongIt)
{
  InformationMatrix information = InformationMatrix::Identity();
  information(0, 3) = information(3, 0) = 0.5;
  Eigen::Matrix<double, 6, 1> motion = Eigen::Matrix<double, 6, 1>::Zero();
  motion[3] = 2;
  FreeMotion along_x;
  along_x.direction = Eigen::Vector3d::UnitX();
  forget(along_x, information);
  EXPECT_NEAR((information * motion).norm(), 0, 1e-12);
  EXPECT_NEAR(information(0, 0), 0.75, 1e-12) << "the Schur complement";
  EXPECT_EQ(information(1, 1), 1);
  const InformationMatrix before = information;
  forget(along_x, information);
  EXPECT_TRUE(information.isApprox(before)) << "there is nothing left to forget";
}

TEST(FreeMotion, IsThereNoneInARoom)
{
  const made::RoomScans scans;
  PairOptions options;
  options.resolution = 0.05;
  const PairResult result =
      PairRegistration(BackendKind::Cpu, 2)
          .align(scans.sourceInput(), scans.targetInput(), options);
  EXPECT_TRUE(result.pose.converged) << result.pose.confidence;
  EXPECT_LT(scans.error(result.pose.T_target_source), 0.05);
  EXPECT_TRUE(result.pose.free_motions.empty());
  EXPECT_GT(result.pose.evidence.hold, 0.5);
}

} // namespace
} // namespace pcl_flashreg
