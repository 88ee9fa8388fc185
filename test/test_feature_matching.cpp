// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "simd/kernels.h"
#include "support/made_features.h"

#include <pcl_flashreg/feature_matching.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace pcl_flashreg {
namespace {

using made::Features;
using made::scattered;

/** \brief All distances in double, sorted. */
std::vector<FeatureMatch>
exhaustive(const FeatureView& queries, const FeatureView& targets, std::size_t k)
{
  std::vector<FeatureMatch> matches;
  const auto distance = [&](std::size_t q, std::size_t t) {
    double sum = 0;
    for (std::size_t d = 0; d < queries.dimension; ++d) {
      const double difference =
          static_cast<double>(queries.data[q * queries.stride + d]) -
          targets.data[t * targets.stride + d];
      sum += difference * difference;
    }
    return sum;
  };
  for (std::size_t q = 0; q < queries.size; ++q) {
    std::vector<std::pair<double, std::int32_t>> all;
    for (std::size_t t = 0; t < targets.size; ++t)
      if (std::isfinite(distance(q, t)))
        all.push_back({distance(q, t), static_cast<std::int32_t>(t)});
    std::sort(all.begin(), all.end());
    for (std::size_t i = 0; i < std::min(k, all.size()); ++i)
      matches.push_back({static_cast<std::int32_t>(q),
                         all[i].second,
                         static_cast<float>(all[i].first)});
  }
  return matches;
}

void
expectSame(const std::vector<FeatureMatch>& a, const std::vector<FeatureMatch>& b)
{
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].query, b[i].query) << i;
    ASSERT_EQ(a[i].match, b[i].match) << i;
    ASSERT_FLOAT_EQ(a[i].squared_distance, b[i].squared_distance) << i;
  }
}

class Matching : public testing::TestWithParam<const char*> {
protected:
  void
  SetUp() override
  {
    setenv("PCL_FLASHREG_CPU", GetParam(), 1);
  }
  void
  TearDown() override
  {
    unsetenv("PCL_FLASHREG_CPU");
  }
};

TEST_P(Matching, EqualsExhaustiveSearchInDouble)
{
  for (const std::size_t dimension : {1, 3, 33, 125})
    for (const std::size_t k : {1, 2, 7}) {
      const Features queries = scattered(130, dimension, dimension, 1);
      const Features targets = scattered(517, dimension, dimension + 2, 2);
      expectSame(matchFeatures(queries.view(), targets.view(), k, 2),
                 exhaustive(queries.view(), targets.view(), k));
    }
}

TEST_P(Matching, InBothDirectionsEqualsTwoSearches)
{
  for (const std::size_t size : {1, 40, 517})
    for (const std::size_t k : {1, 2, 60}) {
      const Features queries = scattered(300, 33, 33, 11);
      Features targets = scattered(size, 33, 35, 12);
      targets.values[0] = std::numeric_limits<float>::quiet_NaN();
      for (const unsigned threads : {1u, 3u}) {
        const MutualMatches both =
            matchFeaturesBothWays(queries.view(), targets.view(), k, threads);
        expectSame(both.forward, exhaustive(queries.view(), targets.view(), k));
        expectSame(both.backward, exhaustive(targets.view(), queries.view(), k));
        std::size_t mutual = 0;
        for (const FeatureMatch& f : both.forward)
          for (const FeatureMatch& b : both.backward)
            mutual += f.query == b.match && f.match == b.query ? 1 : 0;
        EXPECT_EQ(both.mutual().size(), mutual);
        EXPECT_TRUE(size == 1 || mutual > 0);
      }
    }
}

/** \brief Both directions, one and five matches, on one thread and on three. */
void
expectExact(const Features& queries, const Features& targets)
{
  for (const std::size_t k : {1, 5}) {
    const std::vector<FeatureMatch> forward =
        exhaustive(queries.view(), targets.view(), k);
    const std::vector<FeatureMatch> backward =
        exhaustive(targets.view(), queries.view(), k);
    for (const unsigned threads : {1u, 3u}) {
      const MutualMatches both =
          matchFeaturesBothWays(queries.view(), targets.view(), k, threads);
      expectSame(both.forward, forward);
      expectSame(both.backward, backward);
    }
  }
}

TEST_P(Matching, LeavesNothingOutWhereMostIsFar)
{
  for (const double noise : {0.0, 0.1, 3.0}) {
    Features targets = made::onSurface(900, 33, noise, 21);
    std::copy_n(targets.values.begin(), 100 * 33, targets.values.end() - 100 * 33);
    targets.values[500 * 33 + 7] = std::numeric_limits<float>::quiet_NaN();
    expectExact(made::onSurface(300, 33, noise, 22), targets);
  }
}

TEST_P(Matching, TakesOutliers)
{
  Features queries = made::onSurface(200, 33, 0.1, 23);
  Features targets = made::onSurface(300, 33, 0.1, 24);
  queries.values[0] = 1e9f;
  targets.values[40 * 33 + 2] = -1e12f;
  expectExact(queries, targets);
}

/** \brief Neighbours a few roundings from each other, far from the mean of all. */
TEST_P(Matching, TakesTightClusters)
{
  made::Random random(29);
  Features sides[2] = {{{}, 3, 3}, {{}, 3, 3}};
  for (int i = 0; i < 900; ++i)
    for (int d = 0; d < 3; ++d) {
      const double step = std::floor(random.uniform(0, 12)) / 1024;
      sides[i % 3 == 0].values.push_back(
          static_cast<float>((i % 2 == 0 ? 1e4 : -1e4) + step));
    }
  expectExact(sides[1], sides[0]);
}

/** \brief The same far from zero: all values are long, and their differences short. */
TEST_P(Matching, TakesATightClusterFarFromZero)
{
  for (const std::size_t dimension : {3, 33}) {
    made::Random random(30);
    Features sides[2] = {{{}, dimension, dimension}, {{}, dimension, dimension}};
    for (int i = 0; i < 900; ++i)
      for (std::size_t d = 0; d < dimension; ++d)
        sides[i % 3 == 0].values.push_back(
            static_cast<float>(1e4 + std::floor(random.uniform(0, 12)) / 1024));
    expectExact(sides[1], sides[0]);
  }
}

TEST_P(Matching, TakesAnyWidth)
{
  for (const std::size_t dimension : {1, 2, 4, 8, 352})
    expectExact(made::onSurface(70, dimension, 0.1, 25),
                made::onSurface(200, dimension, 0.1, 26));
}

TEST_P(Matching, TakesAnyMagnitude)
{
  const Features queries = made::onSurface(100, 33, 0.1, 27);
  const Features targets = made::onSurface(200, 33, 0.1, 28);
  for (const double factor : {1e-30, 1e-12, 1e17, 1e30})
    expectExact(made::moved(queries, factor, 0), made::moved(targets, factor, 0));
  expectExact(made::moved(queries, 1, 1e6), made::moved(targets, 1, 1e6));
}

TEST_P(Matching, TakesDescriptorsThatAreAllAlike)
{
  for (const float value : {0.0f, 3.0f}) {
    const Features alike{std::vector<float>(100 * 33, value), 33, 33};
    const std::vector<FeatureMatch> matches =
        matchFeatures(alike.view(), alike.view(), 40, 2);
    ASSERT_EQ(matches.size(), 4000u);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      ASSERT_EQ(matches[i].match, static_cast<std::int32_t>(i % 40));
      ASSERT_EQ(matches[i].squared_distance, 0);
    }
  }
}

TEST_P(Matching, TiesGoToTheSmallerIndex)
{
  Features targets = scattered(100, 33, 33, 3);
  for (std::size_t copy : {20u, 50u, 99u})
    std::copy_n(
        targets.values.begin() + 7 * 33, 33, targets.values.begin() + copy * 33);
  const FeatureView query{targets.values.data() + 50 * 33, 1, 33, 33};
  const std::vector<FeatureMatch> matches = matchFeatures(query, targets.view(), 4);
  ASSERT_EQ(matches.size(), 4u);
  EXPECT_EQ(matches[0].match, 7);
  EXPECT_EQ(matches[1].match, 20);
  EXPECT_EQ(matches[2].match, 50);
  EXPECT_EQ(matches[3].match, 99);
  EXPECT_EQ(matches[3].squared_distance, 0);
}

TEST_P(Matching, EqualDescriptorsMatchAsIfEachWereSearched)
{
  for (const int kinds : {1, 2, 6, 40})
    for (const std::size_t dimension : {1, 3, 33}) {
      const Features queries = made::ofFewKinds(150, dimension, kinds, 31);
      Features targets = made::ofFewKinds(260, dimension, kinds, 32);
      targets.values[5 * targets.stride] = std::numeric_limits<float>::quiet_NaN();
      targets.values[9 * targets.stride] = 0.25f;
      for (const std::size_t k : {1, 2, 9, 300})
        for (const unsigned threads : {1u, 3u}) {
          const MutualMatches both =
              matchFeaturesBothWays(queries.view(), targets.view(), k, threads);
          expectSame(both.forward, exhaustive(queries.view(), targets.view(), k));
          expectSame(both.backward, exhaustive(targets.view(), queries.view(), k));
        }
    }
}

TEST_P(Matching, TakesZerosOfEitherSign)
{
  Features queries = made::ofFewKinds(60, 3, 8, 33);
  Features targets = made::ofFewKinds(90, 3, 8, 34);
  for (Features* features : {&queries, &targets})
    for (std::size_t i = 0; i < features->values.size(); i += 3)
      features->values[i] *= -1;
  expectExact(queries, targets);
}

/** \brief The square of their number would be ten thousand million pairs. */
TEST_P(Matching, TakesManyEqualDescriptors)
{
  constexpr std::size_t SIZE = 100000, K = 3;
  const Features alike{std::vector<float>(SIZE * 33, 3.0f), 33, 33};
  const MutualMatches both = matchFeaturesBothWays(alike.view(), alike.view(), K, 2);
  for (const auto& matches : {both.forward, both.backward}) {
    ASSERT_EQ(matches.size(), K * SIZE);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      ASSERT_EQ(matches[i].query, static_cast<std::int32_t>(i / K));
      ASSERT_EQ(matches[i].match, static_cast<std::int32_t>(i % K));
      ASSERT_EQ(matches[i].squared_distance, 0);
    }
  }
  EXPECT_EQ(both.mutual().size(), K * K);
}

TEST_P(Matching, SkipsDescriptorsThatAreNotFinite)
{
  Features queries = scattered(20, 33, 33, 4), targets = scattered(40, 33, 33, 5);
  queries.values[3 * 33 + 5] = std::numeric_limits<float>::quiet_NaN();
  targets.values[8 * 33] = std::numeric_limits<float>::infinity();
  targets.values[9 * 33 + 32] = std::numeric_limits<float>::quiet_NaN();
  const std::vector<FeatureMatch> matches =
      matchFeatures(queries.view(), targets.view(), 40);
  EXPECT_EQ(matches.size(), 19u * 38u);
  for (const FeatureMatch& match : matches) {
    EXPECT_NE(match.query, 3);
    EXPECT_TRUE(match.match != 8 && match.match != 9);
  }
}

/** \brief The variants that this machine has. */
std::vector<const char*>
variants()
{
  std::size_t count = 0;
  const cpu::Kernels* const* kernels = cpu::availableKernels(count);
  std::vector<const char*> names;
  for (std::size_t i = 0; i < count; ++i)
    names.push_back(kernels[i]->name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Variants, Matching, testing::ValuesIn(variants()));

TEST(MatchingInput, EmptyGivesNothing)
{
  const Features some = scattered(5, 33, 33, 6);
  EXPECT_TRUE(matchFeatures({}, some.view()).empty());
  EXPECT_TRUE(matchFeatures(some.view(), {}).empty());
}

TEST(MatchingInput, WithoutAFiniteDescriptorGivesNothing)
{
  const Features some = scattered(5, 33, 33, 6);
  const Features none{
      std::vector<float>(3 * 33, std::numeric_limits<float>::quiet_NaN()), 33, 33};
  EXPECT_TRUE(matchFeatures(none.view(), some.view()).empty());
  EXPECT_TRUE(matchFeatures(some.view(), none.view()).empty());
}

TEST(MatchingInput, RefusesWhatMakesNoSense)
{
  const Features a = scattered(5, 33, 33, 7), b = scattered(5, 32, 32, 8);
  EXPECT_THROW(matchFeatures(a.view(), b.view()), std::invalid_argument);
  EXPECT_THROW(matchFeatures(a.view(), a.view(), 0), std::invalid_argument);
  FeatureView overlapping = a.view();
  overlapping.stride = 32;
  EXPECT_THROW(matchFeatures(overlapping, a.view()), std::invalid_argument);
  FeatureView null = a.view();
  null.data = nullptr;
  EXPECT_THROW(matchFeatures(a.view(), null), std::invalid_argument);
}

TEST(FeatureMatcher, OneObjectMatchesWhateverComes)
{
  FeatureMatcher matcher(2);
  for (const std::size_t dimension : {33, 8, 33})
    for (const std::size_t size : {1, 300, 40}) {
      const Features queries = scattered(size, dimension, dimension, 1);
      const Features targets = scattered(250, dimension, dimension + 3, 2);
      const MutualMatches both = matcher.matchBothWays(queries.view(), targets.view());
      expectSame(matcher.match(queries.view(), targets.view(), 3),
                 exhaustive(queries.view(), targets.view(), 3));
      expectSame(both.backward, exhaustive(targets.view(), queries.view(), 1));
      EXPECT_THROW(matcher.match(queries.view(), targets.view(), 0),
                   std::invalid_argument);
    }
}

} // namespace
} // namespace pcl_flashreg
