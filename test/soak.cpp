// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// A very great number of calls, and how much more memory the process has after them:
//   pcl_flashreg_soak [thousands of estimates] [registrations]
// scripts/soak.sh builds and runs it.

#include "support/made_scans.h"

#include <pcl_flashreg/pair_registration.h>

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <vector>

namespace {

using namespace pcl_flashreg;

/** \brief KiB of this process that are in memory. */
long
residentMemory()
{
  long all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

/** \brief Calls call(i) so many times.
 * \return whether memory stays as it is after the first tenth of them */
bool
staysAsItIs(const char* what, long count, const std::function<void(long)>& call)
{
  // A few pages that the system or the allocator may hold back.
  constexpr long TOLERABLE = 256;
  long i = 0;
  for (; i < count / 10; ++i)
    call(i);
  const long before = residentMemory();
  for (; i < count; ++i)
    call(i);
  const long after = residentMemory();
  std::printf("%ld %s: %ld KiB after a tenth of them, %+ld KiB at the end\n",
              count,
              what,
              before,
              after - before);
  std::fflush(stdout);
  return after - before <= TOLERABLE;
}

std::vector<made::Correspondences>
problems()
{
  std::vector<made::Correspondences> problems;
  for (std::size_t size = 0; size < 60; size += 4) {
    made::Recipe recipe;
    recipe.size = size;
    recipe.inlier_ratio = 0.3;
    recipe.seed = size;
    problems.push_back(made::make(recipe));
  }
  return problems;
}

bool
estimates(long count)
{
  const auto all = problems();
  Parameters parameters;
  parameters.pivots = 20;
  Estimator estimator(BackendKind::Cpu, 1);
  return staysAsItIs("estimates", count, [&](long i) {
    const auto& problem = all[static_cast<std::size_t>(i) % all.size()];
    parameters.second_order = i % 2 ? SecondOrder::Exact : SecondOrder::Bounded;
    estimator.estimate(problem.view(), parameters);
  });
}

bool
estimators(long count)
{
  const auto all = problems();
  return staysAsItIs("estimators, each used once", count, [&](long i) {
    Estimator(BackendKind::Cpu, 2)
        .estimate(all[static_cast<std::size_t>(i) % all.size()].view());
  });
}

bool
registrations(long count)
{
  const made::RoomScans room(1, 60);
  PairRegistration registration(BackendKind::Cpu, 2);
  return staysAsItIs("registrations", count, [&](long i) {
    PairOptions options;
    if (i % 3 > 0)
      options.resolution = i % 3 == 1 ? 0.2 : 0.25;
    options.mutual = i % 2 == 0;
    registration.align(room.sourceInput(), room.targetInput(), options);
  });
}

bool
failures(long count)
{
  const made::RoomScans room(1, 60);
  PairRegistration registration(BackendKind::Cpu, 2);
  return staysAsItIs("registrations that throw", count, [&](long i) {
    PairOptions options;
    options.resolution = 0.2;
    options.on_step = [step = 0,
                       last = i % 3]([[maybe_unused]] const auto& news) mutable {
      if (step++ == last)
        throw std::runtime_error("no further");
    };
    try {
      registration.align(room.sourceInput(), room.targetInput(), options);
      std::abort();
    }
    catch (const std::runtime_error&) {
    }
  });
}

} // namespace

int
main(int argc, char** argv)
{
  const long calls = argc > 1 ? 1000 * std::atol(argv[1]) : 1000000;
  const long pairs = argc > 2 ? std::atol(argv[2]) : 10000;
  bool same = estimates(calls);
  same = estimators(calls / 100) && same;
  same = registrations(pairs) && same;
  same = failures(pairs) && same;
  std::puts(same ? "no growth" : "memory has grown");
  return same ? 0 : 1;
}
