// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Many problems, or pairs of scans, at a time: as one after the other, to the last bit.

#include "support/made_batch.h"
#include "support/made_scans.h"
#include "support/same_result.h"

#include <pcl_flashreg/pair_registration.h>

#include <algorithm>
#include <stdexcept>

namespace pcl_flashreg {
namespace {

class Batches : public testing::TestWithParam<unsigned> {};

TEST_P(Batches, OfCorrespondencesAreAsOneAfterTheOther)
{
  const made::Batch batch;
  std::vector<CorrespondenceView<double>> views = batch.views();
  Estimator one(BackendKind::Cpu, 1), many(BackendKind::Cpu, GetParam());
  std::vector<Result> expected;
  for (const CorrespondenceView<double>& view : views)
    expected.push_back(one.estimate(view));
  EXPECT_TRUE(expected.front().converged);
  EXPECT_EQ(expected[1].status, Status::TooFewCorrespondences);
  // The second time with the memory of the first, and in another order.
  for (int round = 0; round < 2; ++round) {
    const std::vector<Result> found = many.estimateBatch(views);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      expectSameResult(expected[i], found[i]);
    std::reverse(views.begin(), views.end());
    std::reverse(expected.begin(), expected.end());
  }
  EXPECT_TRUE(many.estimateBatch(std::vector<CorrespondenceView<float>>()).empty());
}

TEST_P(Batches, OfScansAreAsOneAfterTheOther)
{
  const made::RoomScans room;
  PairRegistration one(BackendKind::Cpu, 1), many(BackendKind::Cpu, GetParam());
  const double v = made::RoomScans::RESOLUTION;
  const Scan source = one.makeScan(room.sourceInput(), v);
  const Scan target = one.makeScan(room.targetInput(), v);
  const Scan nothing = one.makeScan(ScanInput<double>(), v);
  const std::vector<PairOfScans> pairs{
      {source, target}, {nothing, target}, {target, source}, {source, source}};
  std::size_t steps = 0;
  PairOptions options;
  options.on_step = [&](const PairProgress&) { ++steps; };
  const std::vector<PairResult> found = many.alignBatch(pairs, options);
  ASSERT_EQ(found.size(), pairs.size());
  EXPECT_GT(steps, pairs.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const PairResult expected = one.align(pairs[i].source, pairs[i].target);
    expectSameResult(expected.pose, found[i].pose);
    EXPECT_EQ(expected.matches.size(), found[i].matches.size());
  }
  EXPECT_TRUE(found.front().pose.converged);
}

INSTANTIATE_TEST_SUITE_P(Threads, Batches, testing::Values(1u, 2u, 5u));

TEST(Batch, SaysWhichProblemIsBadAndStaysUsable)
{
  const made::Batch batch;
  std::vector<CorrespondenceView<double>> views = batch.views();
  views[2].target_xyz = nullptr;
  Estimator estimator(BackendKind::Cpu, 2);
  try {
    estimator.estimateBatch(views);
    FAIL();
  }
  catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("problem 2"), std::string::npos)
        << error.what();
  }
  Parameters parameters;
  parameters.pivots = 0;
  EXPECT_THROW(estimator.estimateBatch(batch.views(), parameters),
               std::invalid_argument);
  EXPECT_EQ(estimator.estimateBatch(batch.views()).size(), views.size());
}

TEST(Batch, EndsWithAnExceptionOfACallback)
{
  const made::RoomScans room;
  PairRegistration registration(BackendKind::Cpu, 2);
  const Scan scan =
      registration.makeScan(room.sourceInput(), made::RoomScans::RESOLUTION);
  const std::vector<PairOfScans> pairs(20, {scan, scan});
  std::size_t steps = 0;
  PairOptions options;
  options.on_step = [&](const PairProgress&) {
    ++steps;
    throw std::runtime_error("enough");
  };
  EXPECT_THROW(registration.alignBatch(pairs, options), std::runtime_error);
  EXPECT_LE(steps, 2u); // one a thread
}

TEST(Batch, DeviceMemoryTakesADevice)
{
  const float xyz[9] = {};
  DeviceCorrespondences correspondences;
  correspondences.source_xyz = correspondences.target_xyz = xyz;
  correspondences.size = 3;
  Estimator estimator(BackendKind::Cpu, 1);
  try {
    estimator.estimate(correspondences);
    FAIL();
  }
  catch (const BackendError& error) {
    EXPECT_NE(std::string(error.what()).find("cuda"), std::string::npos);
  }
}

} // namespace
} // namespace pcl_flashreg
