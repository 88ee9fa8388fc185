// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Every SIMD variant and number of threads against every other, on one table of
// problems: equal to the last bit from the first graph to the final pose.

#include "simd/kernels.h"
#include "support/problems.h"
#include "estimation/trace.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>

namespace pcl_flashreg {
namespace {

struct Recording {
  Result result;
  Trace trace;
};

/** \brief Runs a problem on one variant; the variant is chosen when an Estimator is
 * made. */
Recording
runOn(const char* variant, unsigned threads, const made::NamedProblem& problem)
{
  setenv("PCL_FLASHREG_CPU", variant, 1);
  Estimator estimator(BackendKind::Cpu, threads);
  unsetenv("PCL_FLASHREG_CPU");
  EXPECT_EQ(estimator.backendName(), std::string("cpu-") + variant);
  Recording run;
  estimator.setTrace(&run.trace);
  run.result = estimator.estimate(problem.correspondences.view(), problem.parameters);
  return run;
}

template <typename Value>
bool
sameBytes(const std::vector<Value>& a, const std::vector<Value>& b)
{
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

/** \brief EXPECT_EQ compares doubles exactly, which is what is meant here. */
void
expectEqual(const Recording& a, const Recording& b)
{
  EXPECT_TRUE(sameBytes(a.trace.first_order_graph, b.trace.first_order_graph));
  EXPECT_TRUE(sameBytes(a.trace.second_order_graph, b.trace.second_order_graph));
  EXPECT_TRUE(sameBytes(a.trace.pools, b.trace.pools));
  EXPECT_TRUE(sameBytes(a.trace.pivots, b.trace.pivots));
  EXPECT_TRUE(sameBytes(a.trace.cliques, b.trace.cliques));
  EXPECT_EQ(a.trace.hypothesis_valid, b.trace.hypothesis_valid);
  EXPECT_EQ(a.trace.scores, b.trace.scores);
  EXPECT_EQ(a.result.status, b.result.status);
  EXPECT_EQ(a.result.converged, b.result.converged);
  EXPECT_EQ(a.result.T_target_source.rotation, b.result.T_target_source.rotation);
  EXPECT_EQ(a.result.T_target_source.translation, b.result.T_target_source.translation);
  EXPECT_EQ(a.result.inliers, b.result.inliers);
  EXPECT_EQ(a.result.score, b.result.score);
  EXPECT_EQ(a.result.information, b.result.information);
  ASSERT_EQ(a.result.hypotheses.size(), b.result.hypotheses.size());
  for (std::size_t i = 0; i < a.result.hypotheses.size(); ++i) {
    EXPECT_EQ(a.result.hypotheses[i].score, b.result.hypotheses[i].score);
    EXPECT_EQ(a.result.hypotheses[i].T_target_source.translation,
              b.result.hypotheses[i].T_target_source.translation);
  }
}

class Conformance
    : public testing::TestWithParam<std::tuple<std::size_t, SecondOrder, ScoreMetric>> {
};

TEST_P(Conformance, VariantsAndThreadsAgree)
{
  made::NamedProblem problem = made::problems()[std::get<0>(GetParam())];
  problem.parameters.second_order = std::get<1>(GetParam());
  problem.parameters.score_metric = std::get<2>(GetParam());
  const Recording reference = runOn("scalar", 1, problem);
  std::size_t count = 0;
  const cpu::Kernels* const* kernels = cpu::availableKernels(count);
  for (std::size_t i = 0; i < count; ++i)
    for (const unsigned threads : {1u, 2u, 3u}) {
      SCOPED_TRACE(std::string(kernels[i]->name) + ", threads " +
                   std::to_string(threads));
      expectEqual(reference, runOn(kernels[i]->name, threads, problem));
    }
}

INSTANTIATE_TEST_SUITE_P(
    Problems,
    Conformance,
    testing::Combine(testing::Range(std::size_t{0}, made::problems().size()),
                     testing::Values(SecondOrder::Exact, SecondOrder::Bounded),
                     testing::Values(ScoreMetric::Inliers, ScoreMetric::Mse)),
    [](const auto& test) {
      return made::problems()[std::get<0>(test.param)].name +
             (std::get<1>(test.param) == SecondOrder::Exact ? "_exact" : "_bounded") +
             (std::get<2>(test.param) == ScoreMetric::Inliers ? "_inliers" : "_mse");
    });

TEST(Dispatch, RefusesUnknownNames)
{
  setenv("PCL_FLASHREG_CPU", "sse9", 1);
  EXPECT_THROW(Estimator{BackendKind::Cpu}, std::invalid_argument);
  unsetenv("PCL_FLASHREG_CPU");
}

TEST(Dispatch, RefusesVariantsOfOtherProcessors)
{
#if defined(__x86_64__)
  setenv("PCL_FLASHREG_CPU", "neon", 1);
#else
  setenv("PCL_FLASHREG_CPU", "avx2", 1);
#endif
  EXPECT_THROW(Estimator{BackendKind::Cpu}, BackendError);
  unsetenv("PCL_FLASHREG_CPU");
}

TEST(Dispatch, ListsWhatCanRun)
{
  const std::vector<std::string> names = availableBackends();
  ASSERT_FALSE(names.empty());
  EXPECT_EQ(names.back(), "cpu-scalar");
  EXPECT_EQ(Estimator(BackendKind::Auto).backendName(), names.front());
}

} // namespace
} // namespace pcl_flashreg
