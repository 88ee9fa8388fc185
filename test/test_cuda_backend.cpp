// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The CUDA backend from outside, on the emulated device: what it allocates and waits for,
// and what it does where the machine fails.

#include "cuda/estimation/cuda_backend.h"
#include "emulation.h"
#include "cuda/estimation/stages.h"
#include "support/recordings.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

namespace pcl_flashreg {
namespace {

class CudaBackendTest : public testing::Test {
protected:
  void
  SetUp() override
  {
    cuda_emulation::reset();
    named_ = made::sized(200, 0.3);
    pack(named_, problem_);
    expected_ = record(*makeCpuBackend(oneThread()), problem_, named_.parameters);
  }

  /** \brief Without a trace and candidates: copying them waits. */
  PoseEstimate
  run(Backend& backend)
  {
    StageTimings timings;
    StageClock clock(timings);
    return backend.run(
        problem_, named_.parameters, std::nullopt, false, clock, nullptr);
  }

  void
  expectRight(const PoseEstimate& found)
  {
    EXPECT_EQ(found.status, Status::Ok);
    EXPECT_EQ(found.inliers, expected_.estimate.inliers);
    ASSERT_FALSE(found.hypotheses.empty());
    EXPECT_TRUE(
        samePose(found.hypotheses[0].pose, expected_.estimate.hypotheses[0].pose));
  }

  made::NamedProblem named_;
  Problem problem_;
  Recording expected_;
};

TEST_F(CudaBackendTest, WarmCallsAllocateNothingAndWaitOnce)
{
  for (const SecondOrder form :
       {SecondOrder::Exact, SecondOrder::Bounded, SecondOrder::Auto}) {
    named_.parameters.second_order = form;
    const auto backend = makeCudaBackend();
    run(*backend);
    for (const std::size_t size : {200, 150, 3, 200}) {
      pack(made::sized(size, 0.3), problem_);
      const cuda_emulation::Counters before = cuda_emulation::counters();
      run(*backend);
      const cuda_emulation::Counters& after = cuda_emulation::counters();
      EXPECT_EQ(after.allocations, before.allocations) << size;
      EXPECT_EQ(after.synchronisations, before.synchronisations + 1) << size;
      EXPECT_EQ(after.copies, before.copies + 2) << size;
    }
  }
}

TEST_F(CudaBackendTest, ResidentPointsAreCopiedOnce)
{
  cuda::Options options;
  options.resident_points = true;
  const auto backend = cuda::makeBackend(options);
  expectRight(run(*backend));
  const std::size_t before = cuda_emulation::counters().copies;
  for (const SecondOrder form : {SecondOrder::Exact, SecondOrder::Bounded}) {
    named_.parameters.second_order = form;
    run(*backend);
  }
  EXPECT_EQ(cuda_emulation::counters().copies, before + 2); // results alone
  named_.parameters.second_order = SecondOrder::Auto;
  expectRight(run(*backend));
}

TEST_F(CudaBackendTest, EveryStageHasATime)
{
  const auto backend = makeCudaBackend();
  const Recording recording = record(*backend, problem_, named_.parameters);
  const StageTimings& t = recording.timings;
  for (const double time : {t.first_order_graph,
                            t.second_order_graph,
                            t.pivots,
                            t.cliques,
                            t.hypotheses,
                            t.verification,
                            t.refinement})
    EXPECT_GT(time, 0);
}

TEST_F(CudaBackendTest, TimesAreLeftOutOnRequest)
{
  cuda::Options options;
  options.stage_timings = false;
  const auto backend = cuda::makeBackend(options);
  const Recording recording = record(*backend, problem_, named_.parameters);
  EXPECT_EQ(recording.timings.verification, 0);
  expectRight(recording.estimate);
}

TEST_F(CudaBackendTest, CooperativeLaunchesWhereTheDeviceHasThem)
{
  named_.parameters.second_order = SecondOrder::Bounded;
  const auto fused = makeCudaBackend();
  const PoseEstimate one = run(*fused);
  EXPECT_EQ(cuda_emulation::counters().cooperative_launches, 2u);
  cuda_emulation::reset();
  cuda_emulation::device().cooperative_launch = false;
  const auto split = makeCudaBackend();
  const PoseEstimate other = run(*split);
  EXPECT_EQ(cuda_emulation::counters().cooperative_launches, 0u);
  ASSERT_FALSE(one.hypotheses.empty());
  ASSERT_FALSE(other.hypotheses.empty());
  EXPECT_TRUE(samePose(one.hypotheses[0].pose, other.hypotheses[0].pose));
}

/** \brief A graph that needs the other form than the call before, or more room than there
 * is at first, is done over once and fits from then on. */
TEST_F(CudaBackendTest, AutoFollowsTheInput)
{
  const made::NamedProblem sparse = made::sized(400, 0.05), dense = made::sized(400, 1);
  Parameters parameters;
  parameters.row_capacity = 30; // 8 L lies between the two mean degrees
  parameters.pool_capacity = 10;
  const auto cpu = makeCpuBackend(oneThread()), cuda = makeCudaBackend();
  for (const made::NamedProblem* named : {&sparse, &dense, &dense, &sparse, &dense}) {
    pack(*named, problem_);
    expectSame(record(*cpu, problem_, parameters), record(*cuda, problem_, parameters));
  }
  EXPECT_EQ(record(*cuda, problem_, parameters).estimate.second_order,
            SecondOrder::Bounded);
  parameters.second_order = SecondOrder::Exact; // 160 000 entries, room for 51 200
  expectSame(record(*cpu, problem_, parameters), record(*cuda, problem_, parameters));
}

TEST_F(CudaBackendTest, WithoutADeviceThereIsAnErrorAndAutoTakesTheCpu)
{
  cuda_emulation::device().count = 0;
  EXPECT_THROW(Estimator{BackendKind::Cuda}, BackendError);
  EXPECT_EQ(Estimator{BackendKind::Auto}.backendName().substr(0, 4), "cpu-");
  EXPECT_NE(availableBackends().front(), "cuda");
}

TEST_F(CudaBackendTest, WithADeviceAutoTakesIt)
{
  EXPECT_EQ(Estimator{BackendKind::Auto}.backendName(), "cuda");
  EXPECT_EQ(availableBackends().front(), "cuda");
}

TEST_F(CudaBackendTest, RefusesDevicesThatAreTooOld)
{
  cuda_emulation::device().major = 7;
  cuda_emulation::device().minor = 0;
  try {
    makeCudaBackend();
    FAIL();
  }
  catch (const BackendError& error) {
    EXPECT_NE(std::string(error.what()).find("7.0"), std::string::npos) << error.what();
  }
}

TEST_F(CudaBackendTest, RefusesDevicesThatItWasNotBuiltFor)
{
  cuda_emulation::device().has_kernel_image = false;
  EXPECT_THROW(makeCudaBackend(), BackendError);
}

/** \brief Whichever allocation fails: an error, and the same object works afterwards. */
TEST_F(CudaBackendTest, SurvivesAnyFailedAllocation)
{
  std::size_t failures = 0;
  for (const SecondOrder form : {SecondOrder::Exact, SecondOrder::Bounded}) {
    named_.parameters.second_order = form;
    expected_ = record(*makeCpuBackend(oneThread()), problem_, named_.parameters);
    for (std::size_t n = 0;; ++n) {
      cuda_emulation::reset();
      const auto backend = makeCudaBackend();
      cuda_emulation::device().allocations_left = n;
      try {
        run(*backend);
        break; // so many are enough
      }
      catch (const BackendError&) {
        ++failures;
      }
      cuda_emulation::device().allocations_left = 1000;
      if (n % 5 == 0) // that takes its time
        expectRight(run(*backend));
    }
  }
  EXPECT_GT(failures, 20u);
}

TEST_F(CudaBackendTest, SurvivesAnyFailedLaunch)
{
  for (std::size_t n = 0;; ++n) {
    cuda_emulation::reset();
    const auto backend = makeCudaBackend();
    cuda_emulation::device().launches_left = n;
    try {
      run(*backend);
      EXPECT_GT(n, 7u);
      break;
    }
    catch (const BackendError&) {
    }
    cuda_emulation::device().launches_left = 1000;
    expectRight(run(*backend));
  }
}

TEST_F(CudaBackendTest, GivesEverythingBack)
{
  const std::size_t before = cuda_emulation::counters().bytes;
  {
    const auto backend = makeCudaBackend();
    run(*backend);
    EXPECT_GT(cuda_emulation::counters().bytes, before);
  }
  EXPECT_EQ(cuda_emulation::counters().bytes, before);
}

/** \brief Device memory that a call takes for n correspondences. */
std::size_t
bytesFor(std::size_t n, const Parameters& parameters, unsigned mean_degree)
{
  Problem problem;
  problem.resize(n);
  std::fill(problem.sx.begin(), problem.sx.end(), 0.0f);
  for (AlignedBuffer<float>* c :
       {&problem.sy, &problem.sz, &problem.tx, &problem.ty, &problem.tz})
    std::fill(c->begin(), c->end(), 0.0f);
  cuda_emulation::reset();
  cuda::Options options;
  options.expected_degree = mean_degree;
  cuda::Stages stages(options, 132, true);
  StageTimings timings;
  StageClock clock(timings);
  stages.begin(problem, parameters, std::nullopt, clock);
  return cuda_emulation::counters().peak_bytes;
}

TEST(CudaMemory, StaysWithinItsBounds)
{
  Parameters parameters;
  EXPECT_LT(bytesFor(7000, parameters, 128), 20000000u);
  // The densest graph that `auto` takes the exact form for.
  EXPECT_LT(bytesFor(100000, parameters, 8 * parameters.row_capacity), 2000000000u);
  parameters.second_order = SecondOrder::Bounded;
  EXPECT_LT(bytesFor(100000, parameters, 128), 2000000000u);
}

} // namespace
} // namespace pcl_flashreg
