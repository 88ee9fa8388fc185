// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The CUDA backend against the CPU's, on the table of problems that all backends have to
// agree on: equal to the last bit from the first graph to the final pose. One source, two
// programs: on a device, and on the emulated one.

#include "cuda/estimation/cuda_backend.h"
#include "support/datasets.h"
#include "support/device.h"
#include "support/recordings.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

namespace pcl_flashreg {
namespace {

/** \brief How kernels are launched, and in which order the emulated threads run. */
struct Way {
  const char* name;
  bool fused;
  int order;
  unsigned seed;
};

std::vector<Way>
ways()
{
#if defined(PCL_FLASHREG_EMULATED)
  return {{"fused, forward", true, 0, 0},
          {"split, reversed", false, 1, 0},
          {"fused, random", true, 2, 1}};
#else
  return {{"fused", true, 0, 0}, {"split", false, 0, 0}};
#endif
}

Recording
runOnDevice(const Way& way,
            const Problem& problem,
            const Parameters& parameters,
            const std::optional<Pose>& guess = std::nullopt)
{
  freshDevice(way.order, way.seed);
  cuda::Options options;
  options.fused = way.fused;
  return record(*cuda::makeBackend(options), problem, parameters, guess);
}

/** \brief All ways of running it against the CPU. */
void
expectAgreement(const made::NamedProblem& named,
                const std::optional<Pose>& guess = std::nullopt)
{
  Problem problem;
  pack(named, problem);
  if (problem.size < 3) { // the estimator answers these itself
    EXPECT_EQ(runOnDevice(ways().front(), problem, named.parameters).estimate.status,
              Status::NoClique);
    return;
  }
  const Recording expected =
      record(*makeCpuBackend(oneThread()), problem, named.parameters, guess);
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    expectSame(expected, runOnDevice(way, problem, named.parameters, guess));
  }
}

class CudaConformance
    : public testing::TestWithParam<std::tuple<std::size_t, SecondOrder>> {};

TEST_P(CudaConformance, AgreesWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  made::NamedProblem named = made::problems()[std::get<0>(GetParam())];
  named.parameters.second_order = std::get<1>(GetParam());
  expectAgreement(named);
}

INSTANTIATE_TEST_SUITE_P(
    Problems,
    CudaConformance,
    testing::Combine(testing::Range(std::size_t{0}, made::problems().size()),
                     testing::Values(SecondOrder::Exact, SecondOrder::Bounded)),
    [](const auto& test) {
      return made::problems()[std::get<0>(test.param)].name +
             (std::get<1>(test.param) == SecondOrder::Exact ? "_exact" : "_bounded");
    });

/** \brief Parameters far from the usual: more pivots than one block sorts, as many
 * cliques, hypotheses and rounds as there may be, and as few. */
TEST(CudaParameters, AgreesWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  made::NamedProblem named = made::sized(300, 0.4);
  named.parameters.second_order = SecondOrder::Auto;
  named.parameters.pivots = 6000;
  named.parameters.cliques_per_pivot = 3;
  named.parameters.max_hypotheses = 20;
  expectAgreement(named);

  named.parameters.pivots = 1;
  named.parameters.cliques_per_pivot = 16;
  named.parameters.max_hypotheses = 64;
  named.parameters.refinement_iterations = 0;
  expectAgreement(named);

  named.parameters.second_order = SecondOrder::Bounded;
  named.parameters.pivots = 200;
  for (const int capacity : {1, 4096}) {
    named.parameters.row_capacity = capacity;
    named.parameters.pool_capacity = capacity;
    expectAgreement(named);
  }
}

TEST(CudaScores, AgreeWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  for (const ScoreMetric metric : {ScoreMetric::Mae, ScoreMetric::Mse}) {
    made::NamedProblem named = made::sized(200, 0.3);
    named.parameters.score_metric = metric;
    expectAgreement(named);
  }
}

/** \brief A guess is one more hypothesis: a good one wins where cliques are bad, a bad one
 * changes nothing, and it is all there is on an empty graph. */
TEST(CudaGuess, AgreesWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  const made::NamedProblem named = made::sized(150, 0.3);
  Problem problem;
  pack(named, problem);
  const Recording found =
      record(*makeCpuBackend(oneThread()), problem, named.parameters);
  ASSERT_FALSE(found.estimate.hypotheses.empty());
  const Pose good = found.estimate.hypotheses.front().pose;
  const Pose bad = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {50, 0, 0}};
  for (const Pose& guess : {good, bad}) {
    expectAgreement(named, guess);
    expectAgreement(made::emptyGraph(), guess);
  }
}

/** \brief Many clusters of correspondences, each with a pose of its own: refinement goes
 * through batch after batch, and lists more than one. */
TEST(CudaRivals, AgreeWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  made::NamedProblem named = made::sized(10, 1);
  for (std::size_t i = 1; i < 9; ++i) {
    made::Recipe recipe;
    recipe.size = 10 + i;
    recipe.inlier_ratio = 1;
    recipe.seed = 100 + i;
    const made::Correspondences more = made::make(recipe);
    auto& all = named.correspondences;
    all.source.insert(all.source.end(), more.source.begin(), more.source.end());
    all.target.insert(all.target.end(), more.target.begin(), more.target.end());
  }
  for (const int wanted : {1, 5, 9}) {
    named.parameters.max_hypotheses = wanted;
    expectAgreement(named);
  }
  Problem problem;
  pack(named, problem);
  EXPECT_EQ(
      runOnDevice(ways().front(), problem, named.parameters).estimate.hypotheses.size(),
      9u);
}

TEST(CudaRealPair, AgreesWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  const std::string stem = "turboreg_kitti_demo/000_fpfh_kpts_";
  PCL_FLASHREG_NEEDS_DATA(stem + "src.txt");
  made::NamedProblem named{"kitti_000", {}, Parameters::fromResolution(0.3)};
  named.correspondences.source = datasets::readNumbers(stem + "src.txt");
  named.correspondences.target = datasets::readNumbers(stem + "dst.txt");
  expectAgreement(named);
}

TEST(CudaRepetition, GivesTheSameToTheLastBit)
{
  PCL_FLASHREG_NEEDS_DEVICE
  const made::NamedProblem named = made::sized(300, 0.1);
  const auto backend = makeCudaBackend();
  Problem problem;
  pack(named, problem);
  const Recording first = record(*backend, problem, named.parameters);
  for (int run = 0; run < 10; ++run)
    expectSame(first, record(*backend, problem, named.parameters));
}

} // namespace
} // namespace pcl_flashreg
