// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The CUDA backend against the CPU's, on the table of problems that all backends have to
// agree on: equal to the last bit from the first graph to the final pose. One source, two
// programs: on a device, and on the emulated one.

#include "cuda_backend.h"
#include "support/datasets.h"
#include "support/recordings.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

#if defined(PCL_FLASHREG_EMULATED)
#include "emulation.h"
#endif

namespace pcl_flashreg {
namespace {

/** \brief Skips the test where there is no device; the emulation always has one. */
#define PCL_FLASHREG_NEEDS_DEVICE                                                      \
  try {                                                                                \
    makeCudaBackend();                                                                 \
  }                                                                                    \
  catch (const BackendError& error) {                                                  \
    GTEST_SKIP() << error.what();                                                      \
  }

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
          {"fused, random 1", true, 2, 1},
          {"split, random 2", false, 2, 2}};
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
#if defined(PCL_FLASHREG_EMULATED)
  cuda_emulation::reset();
  cuda_emulation::device().order = static_cast<cuda_emulation::Order>(way.order);
  cuda_emulation::device().seed = way.seed;
#endif
  cuda::Options options;
  options.fused = way.fused;
  return record(*cuda::makeBackend(options), problem, parameters, guess);
}

class CudaConformance
    : public testing::TestWithParam<std::tuple<std::size_t, SecondOrder>> {};

TEST_P(CudaConformance, AgreesWithTheCpu)
{
  PCL_FLASHREG_NEEDS_DEVICE
  made::NamedProblem named = made::problems()[std::get<0>(GetParam())];
  named.parameters.second_order = std::get<1>(GetParam());
  Problem problem;
  pack(named, problem);
  if (problem.size < 3) { // the estimator answers these itself
    EXPECT_EQ(runOnDevice(ways().front(), problem, named.parameters).estimate.status,
              Status::NoClique);
    return;
  }
  const auto cpu = makeCpuBackend(1);
  const Recording expected = record(*cpu, problem, named.parameters);
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name);
    expectSame(expected, runOnDevice(way, problem, named.parameters));
  }
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

} // namespace
} // namespace pcl_flashreg
