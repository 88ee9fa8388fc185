// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What the parent of a fork() has used may be used and destroyed in the child.

#include "support/forked_child.h"
#include "support/made_correspondences.h"
#include "support/made_features.h"
#include "support/made_scans.h"
#include "support/thread_pool.h"

#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <memory>

namespace pcl_flashreg {
namespace {

using test::endOfChild;

/** \brief The parameter is the number of threads. */
class Fork : public testing::TestWithParam<unsigned> {
protected:
  void
  SetUp() override
  {
    if (test::threadSanitizer())
      GTEST_SKIP() << "the thread sanitizer knows no threads in a forked child";
  }
};

INSTANTIATE_TEST_SUITE_P(Threads, Fork, testing::Values(1u, 2u, 4u, 8u));

bool
addsUp(ThreadPool& pool)
{
  std::atomic<std::size_t> sum{0};
  pool.forEach(1000, [&sum](std::size_t i, std::size_t) { sum += i; });
  return sum == 499500;
}

TEST_P(Fork, ThreadPoolIsDestroyedInTheChild)
{
  for (int i = 0; i < 40; ++i) {
    auto pool = std::make_unique<ThreadPool>(GetParam());
    ASSERT_TRUE(addsUp(*pool));
    // Those who sleep on a condition variable are why it can't be destroyed.
    if (i % 2 == 0)
      test::waitUntilOthersSleep();
    ASSERT_EQ(endOfChild([&pool] {
                pool.reset();
                return true;
              }),
              "good");
    ASSERT_TRUE(addsUp(*pool));
  }
}

TEST_P(Fork, ThreadPoolIsUsedInTheChildAndItsChild)
{
  for (int i = 0; i < 40; ++i) {
    auto pool = std::make_unique<ThreadPool>(GetParam());
    ASSERT_TRUE(addsUp(*pool));
    if (i % 2 == 0)
      test::waitUntilOthersSleep();
    ASSERT_EQ(endOfChild([&pool] {
                const bool child = addsUp(*pool) && addsUp(*pool);
                const std::string grandchild = endOfChild([&pool] {
                  const bool good = addsUp(*pool);
                  pool.reset();
                  return good;
                });
                const bool again = addsUp(*pool);
                pool.reset();
                return child && grandchild == "good" && again;
              }),
              "good");
    ASSERT_TRUE(addsUp(*pool));
  }
}

TEST_P(Fork, ThreadPoolThatTheChildLeavesAloneIsUsedInItsChild)
{
  ThreadPool pool(GetParam());
  ASSERT_TRUE(addsUp(pool));
  EXPECT_EQ(endOfChild([&pool] {
              return endOfChild([&pool] { return addsUp(pool); }) == "good";
            }),
            "good");
}

TEST_P(Fork, ThreadPoolIsFirstUsedInTheChild)
{
  auto pool = std::make_unique<ThreadPool>(GetParam());
  EXPECT_EQ(endOfChild([&pool] {
              const bool good = addsUp(*pool);
              pool.reset();
              return good;
            }),
            "good");
  EXPECT_TRUE(addsUp(*pool));
}

TEST_P(Fork, StaticThreadPoolIsDestroyedAtTheChildsExit)
{
  static std::map<unsigned, ThreadPool> pools;
  ThreadPool& pool = pools.try_emplace(GetParam(), GetParam()).first->second;
  ASSERT_TRUE(addsUp(pool));
  EXPECT_EQ(endOfChild([] { return true; }), "good");
  EXPECT_EQ(endOfChild([&pool] { return addsUp(pool); }), "good");
  EXPECT_TRUE(addsUp(pool));
}

bool
same(const Result& a, const Result& b)
{
  return a.T_target_source.toMatrix<double>() == b.T_target_source.toMatrix<double>() &&
         a.confidence == b.confidence && a.inliers == b.inliers;
}

/** \brief Forks four times around an object that was used: the child destroys it, or uses
 * it and then does; before and after the parent uses it again.
 * \param[in] isRight uses the object, and says whether the result is the right one */
template <typename Object, typename IsRight>
void
expectForkable(std::unique_ptr<Object> object, const IsRight& isRight)
{
  for (const bool used_in_child : {false, true, false, true}) {
    ASSERT_TRUE(isRight(*object));
    ASSERT_EQ(endOfChild([&] {
                const bool good = !used_in_child || isRight(*object);
                object.reset();
                return good;
              }),
              "good")
        << used_in_child;
  }
  EXPECT_TRUE(isRight(*object));
}

made::Correspondences
someCorrespondences()
{
  made::Recipe recipe;
  recipe.size = 1000;
  recipe.inlier_ratio = 0.2;
  return made::make(recipe);
}

TEST_P(Fork, EstimatorGivesTheSameBitsInTheChild)
{
  const made::Correspondences made = someCorrespondences();
  const Result right = Estimator(BackendKind::Cpu, 1).estimate(made.view());
  ASSERT_TRUE(right.converged);
  expectForkable(std::make_unique<Estimator>(BackendKind::Cpu, GetParam()),
                 [&](Estimator& estimator) {
                   return same(estimator.estimate(made.view()), right);
                 });
}

TEST_P(Fork, StaticEstimatorIsDestroyedAtTheChildsExit)
{
  const made::Correspondences made = someCorrespondences();
  static std::map<unsigned, Estimator> estimators;
  Estimator& estimator =
      estimators.try_emplace(GetParam(), BackendKind::Cpu, GetParam()).first->second;
  const Result right = estimator.estimate(made.view());
  EXPECT_EQ(endOfChild([] { return true; }), "good");
  EXPECT_EQ(endOfChild([&] { return same(estimator.estimate(made.view()), right); }),
            "good");
  EXPECT_TRUE(same(estimator.estimate(made.view()), right));
}

TEST_P(Fork, PairRegistrationGivesTheSameBitsInTheChild)
{
  const made::RoomScans room;
  PairOptions options;
  options.resolution = made::RoomScans::RESOLUTION;
  const auto align = [&](PairRegistration& registration) {
    return registration.align(room.sourceInput(), room.targetInput(), options).pose;
  };
  PairRegistration alone(BackendKind::Cpu, 1);
  const Result right = align(alone);
  ASSERT_TRUE(right.converged);
  expectForkable(
      std::make_unique<PairRegistration>(BackendKind::Cpu, GetParam()),
      [&](PairRegistration& registration) { return same(align(registration), right); });
}

TEST_P(Fork, FeatureExtractorGivesTheSameBitsInTheChild)
{
  const made::RoomScans room;
  const std::vector<float> points(room.source.begin(), room.source.end());
  PointView view;
  view.data = points.data();
  view.size = points.size() / 3;
  const auto parameters =
      FeatureParameters::fromResolution(made::RoomScans::RESOLUTION);
  const DescribedCloud right = FeatureExtractor(1).describe(view, parameters);
  ASSERT_GT(right.size, 0u);
  expectForkable(
      std::make_unique<FeatureExtractor>(GetParam()), [&](FeatureExtractor& extractor) {
        return extractor.describe(view, parameters).descriptors == right.descriptors;
      });
}

TEST_P(Fork, FeatureMatcherGivesTheSameInTheChild)
{
  const made::Features queries = made::scattered(500, 33, 33, 1),
                       targets = made::scattered(700, 33, 33, 2);
  const auto ofQueries = [](const std::vector<FeatureMatch>& matches) {
    std::vector<std::int32_t> numbers;
    for (const FeatureMatch& match : matches)
      numbers.push_back(match.match);
    return numbers;
  };
  const auto right = ofQueries(matchFeatures(queries.view(), targets.view(), 1, 1));
  ASSERT_EQ(right.size(), 500u);
  expectForkable(
      std::make_unique<FeatureMatcher>(GetParam()), [&](FeatureMatcher& matcher) {
        return ofQueries(matcher.match(queries.view(), targets.view())) == right;
      });
}

} // namespace
} // namespace pcl_flashreg
