// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Every step that shares its work among threads, and objects that threads share: for the
// thread sanitizer, which sees what no comparison of results does.

#include "support/made_scans.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <memory>
#include <thread>
#include <vector>

namespace pcl_flashreg {
namespace {

using made::RoomScans;

// Many points, which are dealt out to threads, and few voxels, which take long.
constexpr double V = 0.2;
constexpr unsigned THREADS = 3;

const RoomScans&
room()
{
  static const RoomScans scans;
  return scans;
}

bool
same(const Result& a, const Result& b)
{
  return a.T_target_source.toMatrix<double>() == b.T_target_source.toMatrix<double>() &&
         a.confidence == b.confidence && a.inliers == b.inliers;
}

PairResult
alignWith(PairRegistration& registration)
{
  PairOptions options;
  options.mutual = true;
  options.resolution = V;
  return registration.align(room().sourceInput(), room().targetInput(), options);
}

TEST(Threads, ShareTheStepsOfARegistration)
{
  PairRegistration alone(BackendKind::Cpu, 1), together(BackendKind::Cpu, THREADS);
  const PairResult expected = alignWith(alone);
  EXPECT_TRUE(expected.pose.converged);
  // Later calls find threads and memory that are there already.
  for (int call = 0; call < 3; ++call) {
    const PairResult found = alignWith(together);
    EXPECT_TRUE(same(expected.pose, found.pose));
    EXPECT_EQ(expected.target.serialize(), found.target.serialize());
  }
}

TEST(Threads, ShareTheStagesOfAnEstimate)
{
  made::Recipe recipe;
  recipe.size = 800;
  const made::Correspondences correspondences = made::make(recipe);
  for (const SecondOrder form : {SecondOrder::Exact, SecondOrder::Bounded}) {
    Parameters parameters;
    parameters.second_order = form;
    Estimator alone(BackendKind::Cpu, 1), together(BackendKind::Cpu, THREADS);
    const Result expected = alone.estimate(correspondences.view(), parameters);
    for (int call = 0; call < 3; ++call)
      EXPECT_TRUE(
          same(expected, together.estimate(correspondences.view(), parameters)));
  }
}

/** \brief Objects of their own, made at the same time, on scans that all of them use. */
TEST(Threads, ShareABatch)
{
  PairRegistration alone(BackendKind::Cpu, 1), together(BackendKind::Cpu, THREADS);
  const Scan source = alone.makeScan(room().sourceInput(), V);
  const Scan target = alone.makeScan(room().targetInput(), V);
  const Result expected = alone.align(source, target).pose;
  for (const PairResult& found :
       together.alignBatch(std::vector<PairOfScans>(5, {source, target})))
    EXPECT_TRUE(same(expected, found.pose));
}

TEST(Threads, UseOneScan)
{
  PairRegistration maker(BackendKind::Cpu, 1);
  const Scan source = maker.makeScan(room().sourceInput(), V),
             target = maker.makeScan(room().targetInput(), V);
  const PairResult expected = maker.align(source, target);
  std::vector<std::unique_ptr<PairResult>> found(THREADS);
  std::vector<std::thread> users;
  for (auto& result : found)
    users.emplace_back([&result, source, target] {
      PairRegistration registration(BackendKind::Cpu, 2);
      result = std::make_unique<PairResult>(
          registration.align(source.withoutViewpoint(), target));
      *result = registration.align(source, target);
    });
  for (std::thread& user : users)
    user.join();
  for (const auto& result : found)
    EXPECT_TRUE(same(expected.pose, result->pose));
}

} // namespace
} // namespace pcl_flashreg
