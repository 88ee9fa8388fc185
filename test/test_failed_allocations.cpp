// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What the core does where memory runs out, at every place where it takes some.

#include "support/failing_allocations.h"
#include "support/made_scans.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/pair_registration.h>
#include <pcl_flashreg/resolution.h>

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

namespace pcl_flashreg {
namespace {

namespace failing = failing_allocations;
namespace fs = std::filesystem;
using failing::Mode;
using made::RoomScans;

constexpr double V = 0.2;

const RoomScans&
room()
{
  static const RoomScans scans(1, 60);
  return scans;
}

template <typename Value>
void
append(std::string& bytes, const Value* values, std::size_t count)
{
  if (count > 0)
    bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

/** \brief All that two results have to agree in, to the last bit. */
std::string
bytesOf(const Result& result)
{
  std::string bytes;
  append(bytes, result.T_target_source.rotation.data(), 9);
  append(bytes, result.T_target_source.translation.data(), 3);
  append(bytes, &result.confidence, 1);
  append(bytes, result.inliers.data(), result.inliers.size());
  append(bytes, result.information.data(), 36);
  for (const Hypothesis& hypothesis : result.hypotheses)
    append(bytes, hypothesis.T_target_source.translation.data(), 3);
  return bytes;
}

std::string
bytesOf(const std::vector<FeatureMatch>& matches)
{
  std::string bytes;
  append(bytes, matches.data(), matches.size());
  return bytes;
}

/** \brief Calls `call` on an object of `make` with one allocation after the other failing.
 * A call that fails has thrown std::bad_alloc, has lost nothing, and the next call on the
 * same object gives what it gives on any other.
 * \param[in] step every how manieth allocation
 * \return how many calls failed
 */
template <typename Make, typename Call>
std::size_t
failOneByOne(Mode mode, std::size_t step, const Make& make, const Call& call)
{
  const std::string expected = call(*make());
  std::size_t failures = 0;
  for (std::size_t skip = 0;; skip += step) {
    const long before = failing::liveBlocks();
    {
      const auto object = make();
      std::string found;
      bool thrown = false;
      failing::begin(mode, skip);
      try {
        found = call(*object);
      }
      catch (const std::bad_alloc&) {
        thrown = true;
      }
      const std::size_t failed = failing::end();
      failures += thrown;
      // Where there is another way, as in std::stable_sort(), it leads to the same.
      if (!thrown) {
        EXPECT_EQ(found, expected) << "allocation " << skip;
      }
      // What workers get to do is not the same every time.
      const bool at_end = mode != Mode::OfWorkersOnce || skip >= 20 * step;
      if (failed == 0 && at_end)
        return failures;
      EXPECT_EQ(call(*object), expected) << "after allocation " << skip;
    }
    EXPECT_EQ(failing::liveBlocks(), before) << "allocation " << skip;
    if (testing::Test::HasFailure())
      return failures;
  }
}

class FailedAllocations : public testing::TestWithParam<std::pair<Mode, unsigned>> {
protected:
  Mode
  mode() const
  {
    return GetParam().first;
  }

  unsigned
  threads() const
  {
    return GetParam().second;
  }

  auto
  registration() const
  {
    return [this] {
      return std::make_unique<PairRegistration>(BackendKind::Cpu, threads());
    };
  }

  template <typename Make, typename Call>
  void
  expectSound(const Make& make, const Call& call, std::size_t step = 1)
  {
    const std::size_t failures = failOneByOne(mode(), step, make, call);
    // Workers may find all the work done.
    if (mode() != Mode::OfWorkersOnce) {
      EXPECT_GT(failures, 0u);
    }
    RecordProperty("failures", static_cast<int>(failures));
  }

  const ScanInput<double> source = room().sourceInput(), target = room().targetInput();
};

TEST_P(FailedAllocations, OfConstruction)
{
  expectSound([] { return std::make_unique<int>(); },
              [this](int) {
                return PairRegistration(BackendKind::Cpu, threads()).backendName();
              });
}

TEST_P(FailedAllocations, OfAScan)
{
  expectSound(registration(), [&](PairRegistration& registration) {
    return registration.makeScan(source, V).serialize();
  });
}

TEST_P(FailedAllocations, OfMatching)
{
  const Scan from = registration()()->makeScan(source, V),
             to = registration()()->makeScan(target, V);
  PairOptions options;
  options.mutual = true;
  expectSound(registration(), [&](PairRegistration& registration) {
    return bytesOf(registration.match(from, to, options));
  });
}

TEST_P(FailedAllocations, OfAnEstimate)
{
  made::Recipe recipe;
  recipe.size = 100;
  recipe.inlier_ratio = 0.4;
  const made::Correspondences correspondences = made::make(recipe);
  for (const SecondOrder form : {SecondOrder::Exact, SecondOrder::Bounded}) {
    Parameters parameters;
    parameters.second_order = form;
    parameters.pivots = 50;
    expectSound(
        [this] { return std::make_unique<Estimator>(BackendKind::Cpu, threads()); },
        [&](Estimator& estimator) {
          return bytesOf(estimator.estimate(correspondences.view(), parameters));
        });
  }
}

TEST_P(FailedAllocations, OfARegistration)
{
  expectSound(
      registration(),
      [&](PairRegistration& registration) {
        const PairResult result = registration.align(source, target);
        EXPECT_TRUE(result.pose.converged);
        return bytesOf(result.pose) + result.source.serialize();
      },
      47);
}

/** \brief The second call takes other paths: what is kept is too small, or is not. */
TEST_P(FailedAllocations, OfASecondRegistration)
{
  PairOptions options;
  options.resolution = V;
  const auto align = [&](PairRegistration& registration) {
    return bytesOf(registration.align(source, target, options).pose);
  };
  expectSound(
      [&] {
        auto object = registration()();
        PairOptions coarser;
        coarser.resolution = 2 * V;
        object->align(target, source, coarser);
        return object;
      },
      align,
      97);
}

std::string
nameOf(const testing::TestParamInfo<std::pair<Mode, unsigned>>& instance)
{
  const char* names[] = {"", "Once", "FromThenOn", "OfWorkersOnce"};
  return names[static_cast<int>(instance.param.first)] +
         std::to_string(instance.param.second) + "Threads";
}

INSTANTIATE_TEST_SUITE_P(All,
                         FailedAllocations,
                         testing::Values(std::make_pair(Mode::Once, 1u),
                                         std::make_pair(Mode::FromThenOn, 1u),
                                         std::make_pair(Mode::Once, 3u),
                                         std::make_pair(Mode::FromThenOn, 3u),
                                         std::make_pair(Mode::OfWorkersOnce, 3u)),
                         nameOf);

TEST(FailedAllocation, OfAWorkerReachesTheCaller)
{
  using Clock = std::chrono::steady_clock;
  ThreadPool pool(3);
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> tried{false};
  const auto task = [&](std::size_t, std::size_t) {
    if (std::this_thread::get_id() != caller) {
      tried = true;
      ::operator delete(::operator new(sizeof(int)));
    }
    // The caller leaves the others something to do.
    for (const auto start = Clock::now();
         !tried && Clock::now() < start + std::chrono::seconds(10);)
      std::this_thread::yield();
  };
  pool.forEach(3, task);
  tried = false;
  failing::begin(Mode::OfWorkersOnce, 0);
  EXPECT_THROW(pool.forEach(3, task), std::bad_alloc);
  EXPECT_EQ(failing::end(), 1u);
  EXPECT_NO_THROW(pool.forEach(3, task));
}

/** \brief A folder of its own, which goes with the test. */
class FailedAllocationsOfFiles : public testing::Test {
protected:
  FailedAllocationsOfFiles()
  {
    fs::remove_all(folder);
    fs::create_directories(folder);
    PairRegistration registration(BackendKind::Cpu, 1);
    scan = registration.makeScan(room().sourceInput(), V);
    other = registration.makeScan(room().targetInput(), V);
  }

  ~FailedAllocationsOfFiles() override
  {
    fs::remove_all(folder);
  }

  const fs::path folder = fs::path(testing::TempDir()) / "failed_allocations_of_files";
  const std::string path = (folder / "a.scan").string();
  Scan scan, other;
};

TEST_F(FailedAllocationsOfFiles, LeaveWhatWasThere)
{
  other.save(path);
  for (std::size_t skip = 0;; ++skip) {
    failing::begin(Mode::Once, skip);
    bool thrown = false;
    try {
      scan.save(path);
    }
    catch (const std::bad_alloc&) {
      thrown = true;
    }
    const std::size_t failed = failing::end();
    const auto files = std::distance(fs::directory_iterator(folder), {});
    EXPECT_EQ(files, 1) << "allocation " << skip;
    EXPECT_EQ(Scan::load(path).serialize(), (thrown ? other : scan).serialize())
        << "allocation " << skip;
    if (failed == 0 || HasFailure())
      break;
    other.save(path);
  }
}

TEST_F(FailedAllocationsOfFiles, LeaveNoHalfOfAScan)
{
  scan.save(path);
  const std::string expected = scan.serialize();
  const auto nothing = [] { return std::make_unique<int>(); };
  EXPECT_GT(
      failOneByOne(
          Mode::Once, 1, nothing, [&](int) { return Scan::load(path).serialize(); }),
      5u);
}

} // namespace
} // namespace pcl_flashreg
