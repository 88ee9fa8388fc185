// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Every row of the ablation against the CPU: what is timed has to compute what it says. One
// source, two programs: on a device, and on the emulated one.

#include "ablation.h"
#include "ablation_stages.h"
#include "support/device.h"
#include "support/recordings.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

namespace pcl_flashreg::benchmark {
namespace {

Recording
record(AblationStages& stages, const Problem& problem, const Parameters& parameters)
{
  Recording recording;
  StageClock clock(recording.timings);
  recording.estimate = runPipeline(
      stages, problem, parameters, std::nullopt, true, clock, &recording.trace);
  return recording;
}

/** \brief What a row has to give. Where FastSOG's rows become a dense matrix, pivots come
 * from all that they hold, as from pools as long as the rows. */
Recording
expectedOf(const AblationRow& row, const Problem& problem, Parameters parameters)
{
  const bool bounded = row.second_order == SecondOrderModule::FastSog;
  parameters.second_order = bounded ? SecondOrder::Bounded : SecondOrder::Exact;
  if (!row.dataflow)
    parameters.pool_capacity = parameters.row_capacity;
  return pcl_flashreg::record(*makeCpuBackend(oneThread()), problem, parameters);
}

/** \brief Equality through the scores of the hypotheses; the pose but for the rounding of
 * sums, which are in another order. */
void
expectSameButForRounding(const Recording& expected, Recording found)
{
  const auto &a = expected.estimate.hypotheses, &b = found.estimate.hypotheses;
  ASSERT_EQ(a.empty(), b.empty());
  if (!a.empty()) {
    EXPECT_EQ(b.size(), 1u);
    EXPECT_EQ(a[0].inlier_count, b[0].inlier_count);
    EXPECT_EQ(a[0].score, b[0].score);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(a[0].pose.r[i], b[0].pose.r[i], 1e-12) << i;
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(a[0].pose.t[i], b[0].pose.t[i], 1e-12) << i;
  }
  found.estimate.hypotheses = a;
  expectSame(expected, found);
}

made::NamedProblem
withPivots(made::NamedProblem named, int pivots)
{
  named.parameters.pivots = pivots;
  return named;
}

/** \brief More entries than FastSOG's rows and pools hold, more cliques a pivot than the
 * small kernel has room for, another metric, and rounds that end before they converge. */
made::NamedProblem
unusual()
{
  made::NamedProblem named = withPivots(made::sized(130, 0.9), 40);
  named.name = "unusual_parameters";
  named.parameters.row_capacity = 20;
  named.parameters.pool_capacity = 5;
  named.parameters.cliques_per_pivot = 5;
  named.parameters.score_metric = ScoreMetric::Mae;
  named.parameters.refinement_iterations = 1;
  return named;
}

std::vector<made::NamedProblem>
problems()
{
  return {made::sized(3, 1),
          withPivots(made::sized(33, 0.3), 200),
          withPivots(made::sized(129, 0.3), 200),
          withPivots(made::sized(300, 0.3), 200),
          withPivots(made::emptyGraph(), 50),
          withPivots(made::tiedGrid(), 60),
          unusual()};
}

class CudaAblationRows : public testing::TestWithParam<std::tuple<std::size_t, int>> {};

TEST_P(CudaAblationRows, GiveWhatTheCpuGives)
{
  PCL_FLASHREG_NEEDS_DEVICE
  const made::NamedProblem named = problems()[std::get<0>(GetParam())];
  Problem problem;
  pack(named, problem);
  for (const AblationRow& row : ablationRows()) {
    SCOPED_TRACE(row.name);
    Recording expected = expectedOf(row, problem, named.parameters);
    freshDevice(std::get<1>(GetParam()));
    AblationStages stages(row);
    Recording found = record(stages, problem, named.parameters);
    if (!row.dataflow) // the kernel's own pools are still there, but nobody reads them
      expected.trace.pools = found.trace.pools = {};
    if (row.own_rest)
      expectSame(expected, found);
    else
      expectSameButForRounding(expected, found);
  }
}

std::string
nameOf(const testing::TestParamInfo<CudaAblationRows::ParamType>& test)
{
  constexpr const char* orders[] = {"_forward", "_reversed", "_random"};
  return problems()[std::get<0>(test.param)].name + orders[std::get<1>(test.param)];
}

INSTANTIATE_TEST_SUITE_P(Problems,
                         CudaAblationRows,
                         testing::Combine(testing::Range(std::size_t{0},
                                                         problems().size()),
                                          testing::Values(0)),
                         nameOf);

INSTANTIATE_TEST_SUITE_P(OtherOrders,
                         CudaAblationRows,
                         testing::Combine(testing::Values(std::size_t{1}),
                                          testing::Values(1, 2)),
                         nameOf);

TEST(CudaAblation, RepeatsToTheLastBit)
{
  PCL_FLASHREG_NEEDS_DEVICE
  const made::NamedProblem named = withPivots(made::sized(100, 0.3), 50);
  Problem problem;
  pack(named, problem);
  for (const AblationRow& row : ablationRows()) {
    SCOPED_TRACE(row.name);
    freshDevice();
    AblationStages stages(row);
    const Recording first = record(stages, problem, named.parameters);
    freshDevice(2, 1);
    expectSame(first, record(stages, problem, named.parameters));
  }
}

TEST(CudaAblation, EveryStageHasATimeAndEveryRowTheSameInliers)
{
  PCL_FLASHREG_NEEDS_DEVICE
  freshDevice();
  const made::NamedProblem named = withPivots(made::sized(60, 0.3), 30);
  Problem problem;
  pack(named, problem);
  const std::vector<AblationMeasurement> rows =
      measureAblation(problem, named.parameters, {1});
  ASSERT_EQ(rows.size(), ablationRows().size());
  for (const AblationMeasurement& m : rows) {
    EXPECT_EQ(m.inliers, rows.front().inliers) << m.row.name;
    EXPECT_GT(m.device_bytes, 0u) << m.row.name;
    for (std::size_t s = 0; s < m.stages.size(); ++s)
      if (ABLATION_STAGES[s].milliseconds == &StageTimings::pivots &&
          m.row.pivotsInSecondOrder())
        EXPECT_EQ(m.stages[s].median, 0) << m.row.name;
      else
        EXPECT_GT(m.stages[s].median, 0) << m.row.name;
  }
  testing::internal::CaptureStdout();
  printAblation(rows);
  const std::string table = testing::internal::GetCapturedStdout();
  for (const AblationMeasurement& m : rows)
    EXPECT_NE(table.find("\n" + m.row.name + " "), std::string::npos);
}

#if defined(PCL_FLASHREG_EMULATED)

/** \brief What is said to be held is what is, and stays so. */
TEST(CudaAblation, CountsItsMemory)
{
  Problem problem;
  const made::NamedProblem named = withPivots(made::sized(200, 0.3), 100);
  pack(named, problem);
  for (const AblationRow& row : ablationRows()) {
    cuda_emulation::reset();
    AblationStages stages(row);
    record(stages, problem, named.parameters);
    EXPECT_EQ(stages.deviceBytes(), cuda_emulation::counters().bytes) << row.name;
    EXPECT_EQ(stages.deviceBytes(), cuda_emulation::counters().peak_bytes) << row.name;
    const std::size_t allocations = cuda_emulation::counters().allocations;
    record(stages, problem, named.parameters);
    EXPECT_EQ(cuda_emulation::counters().allocations, allocations) << row.name;
  }
}

/** \brief The dense rows' memory, of n correspondences: rows of n numbers for both graphs
 * and for the residuals of every slot; room to sort the edges; cuBLAS' workspace. What else
 * there is grows with n and the slots alone. */
TEST(CudaAblation, TakesTheMemoryOfMatrices)
{
  Problem problem;
  const made::NamedProblem named = withPivots(made::sized(300, 0.3), 100);
  pack(named, problem);
  for (const AblationRow& row : ablationRows()) {
    if (row.fast_fog || row.sparse())
      continue;
    cuda_emulation::reset();
    AblationStages stages(row);
    const Recording found = record(stages, problem, named.parameters);
    const std::size_t n = 300, stride = 320, slots = 2 * 100 + 1;
    const std::size_t graph =
        row.second_order == SecondOrderModule::HalfProduct ? 2 : 4;
    const std::size_t matrices = (graph + 4) * n * stride + 4 * slots * stride +
                                 16 * found.trace.second_order_graph.size() +
                                 (std::size_t{32} << 20);
    EXPECT_GT(stages.deviceBytes(), matrices) << row.name;
    EXPECT_LT(stages.deviceBytes(), matrices + 200 * (n + slots)) << row.name;
  }
}

/** \brief What a call takes before its first kernel; the dense rows need more, to sort. */
TEST(CudaAblation, ThisProjectTakesATwentiethOfTheDenseMemory)
{
  Problem problem;
  made::Recipe recipe;
  recipe.size = 7000;
  prepare(made::make(recipe).view(), Parameters(), problem);
  const auto bytesOf = [&](const AblationRow& row) {
    cuda_emulation::reset();
    AblationStages stages(row);
    StageTimings timings;
    StageClock clock(timings);
    stages.begin(problem, Parameters::fromResolution(0.05), std::nullopt, clock);
    return stages.deviceBytes();
  };
  const std::size_t dense = bytesOf(ablationRows().front());
  for (const AblationRow& row : ablationRows())
    if (row.own_rest) {
      EXPECT_LT(20 * bytesOf(row), dense) << row.name;
    }
}

/** \brief Whichever launch or allocation fails: an error, and nothing is left behind. */
TEST(CudaAblation, ReportsFailures)
{
  Problem problem;
  const made::NamedProblem named = withPivots(made::sized(40, 0.3), 20);
  pack(named, problem);
  for (std::size_t cuda_emulation::Device::*left :
       {&cuda_emulation::Device::launches_left,
        &cuda_emulation::Device::allocations_left}) {
    std::size_t failures = 0;
    for (bool failed = true; failed; failures += failed) {
      failed = false;
      cuda_emulation::reset();
      const std::size_t before = cuda_emulation::counters().bytes;
      cuda_emulation::device().*left = failures;
      try {
        AblationStages stages(ablationRows().front());
        record(stages, problem, named.parameters);
      }
      catch (const BackendError&) {
        failed = true;
      }
      EXPECT_EQ(cuda_emulation::counters().bytes, before);
    }
    EXPECT_GT(failures, 10u);
  }
}

#endif

} // namespace
} // namespace pcl_flashreg::benchmark
