// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "simd/kernels.h"
#include "matching/cpu/feature_tree.h"
#include "support/made_features.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pcl_flashreg {
namespace {

using made::Features;

/** \brief What a search starts from. */
struct Planted {
  Features queries, targets;
  DistinctFeatures distinct[2];
  FeatureSpace space;
  std::vector<FeatureTree> trees;

  Planted(Features q, Features t, unsigned threads)
      : queries(std::move(q)),
        targets(std::move(t)),
        distinct{DistinctFeatures(queries.view()), DistinctFeatures(targets.view())},
        space(distinct[0], distinct[1])
  {
    ThreadPool pool(threads);
    trees = plantTrees({&distinct[0], &distinct[1]}, space, pool);
  }

  double
  distance(std::size_t q, std::size_t t) const
  {
    double sum = 0;
    for (std::size_t d = 0; d < space.dimension(); ++d) {
      const double difference =
          static_cast<double>(distinct[0][q][d]) - distinct[1][t][d];
      sum += difference * difference;
    }
    return std::sqrt(sum) * space.scale();
  }
};

/** \brief Descriptors of a few dimensions only, of all, far from the origin, large, tiny. */
std::vector<Features>
kinds(std::size_t size, std::uint64_t seed)
{
  return {made::onSurface(size, 33, 0, seed),
          made::onSurface(size, 33, 0.1, seed),
          made::scattered(size, 33, 35, seed),
          made::scattered(size, 1, 1, seed),
          made::scattered(size, 3, 3, seed),
          made::scattered(size, 4, 4, seed),
          made::moved(made::scattered(size, 33, 33, seed), 1, 1e5),
          made::moved(made::onSurface(size, 33, 0, seed), 1e18, 0),
          made::moved(made::onSurface(size, 33, 0, seed), 1e-30, 0)};
}

TEST(FeatureTree, ShadowsAreNotFartherThanWhatCastsThem)
{
  const std::vector<Features> queries = kinds(60, 1), targets = kinds(300, 2);
  for (std::size_t kind = 0; kind < queries.size(); ++kind) {
    const Planted planted(queries[kind], targets[kind], 1);
    double longest[2] = {}, most = 0, all = 0;
    for (int side = 0; side < 2; ++side)
      for (const Shadow& shadow : planted.trees[side].shadows)
        longest[side] =
            std::max<double>(longest[side], std::sqrt(shadow.square().sum()));
    const double error = planted.space.slack() * (longest[0] + longest[1]);
    for (std::size_t q = 0; q < planted.distinct[0].size(); ++q)
      for (std::size_t t = 0; t < planted.distinct[1].size(); ++t) {
        const Eigen::Array4d gap = planted.trees[0].shadows[q].cast<double>() -
                                   planted.trees[1].shadows[t].cast<double>();
        const double shadow = std::sqrt(gap.square().sum());
        const double distance =
            planted.distance(static_cast<std::size_t>(planted.trees[0].order[q]),
                             static_cast<std::size_t>(planted.trees[1].order[t]));
        ASSERT_LE(shadow, distance + error) << kind << ": " << q << ", " << t;
        most += shadow;
        all += distance;
      }
    // The bound is worth something: all of it where three dimensions are all there are.
    EXPECT_GT(most, (kind == 2 || kind == 6 ? 0.3 : 0.9) * all) << kind;
    EXPECT_LT(error, 1e-5 * (longest[0] + longest[1]));
  }
}

/** \brief Checks the boxes from a node down; counts the leaves. */
void
expectBounds(const FeatureTree& tree,
             std::size_t node,
             std::size_t begin,
             std::size_t end,
             std::size_t& leaves)
{
  constexpr std::size_t BLOCK = cpu::FEATURE_BLOCK;
  const std::size_t last = std::min(end * BLOCK, tree.shadows.size());
  const ShadowBox box = tree.bounds(begin * BLOCK, last);
  EXPECT_TRUE((box.low == tree.boxes[node].low).all());
  EXPECT_TRUE((box.high == tree.boxes[node].high).all());
  if (end - begin == 1) {
    ++leaves;
    return;
  }
  const std::size_t middle = FeatureTree::middle(begin, end);
  expectBounds(tree, node + 1, begin, middle, leaves);
  expectBounds(tree, FeatureTree::rightChild(node, begin, end), middle, end, leaves);
}

TEST(FeatureTree, HoldsEachDescriptorOnceInBoxesThatBoundIt)
{
  for (const std::size_t size : {1, 8, 31, 32, 33, 97, 1000})
    for (const unsigned threads : {1u, 2u, 5u}) {
      Features targets = made::onSurface(size + 1, 33, 0.1, size);
      targets.values[33] = std::numeric_limits<float>::quiet_NaN();
      const Planted planted(made::onSurface(20, 33, 0.1, 9), targets, threads);
      const FeatureTree& tree = planted.trees[1];
      std::vector<std::int32_t> sorted = tree.order;
      std::sort(sorted.begin(), sorted.end());
      ASSERT_EQ(sorted.size(), size);
      for (std::size_t i = 0; i < size; ++i)
        EXPECT_EQ(sorted[i], static_cast<std::int32_t>(i));
      std::vector<Shadow> shadows(size);
      planted.space.cast(planted.distinct[1], 0, size, shadows.data());
      for (std::size_t i = 0; i < size; ++i) {
        const Shadow& shadow = shadows[static_cast<std::size_t>(tree.order[i])];
        EXPECT_LT((shadow - tree.shadows[i]).abs().maxCoeff(), 1e-6f);
      }
      std::size_t leaves = 0;
      expectBounds(tree, 0, 0, tree.blocks(), leaves);
      EXPECT_EQ(leaves, (size + 31) / 32);
    }
}

TEST(FeatureTree, HoldsEqualDescriptorsOnce)
{
  Features targets = made::ofFewKinds(5000, 33, 200, 3);
  targets.values[0] = std::numeric_limits<float>::infinity();
  const Planted planted(made::ofFewKinds(3000, 33, 7, 4), targets, 2);
  EXPECT_EQ(planted.trees[0].order.size(), 7u);
  EXPECT_EQ(planted.trees[1].order.size(), 200u);
  const DistinctFeatures& distinct = planted.distinct[1];
  EXPECT_EQ(distinct.finite.size(), 4999u);
  EXPECT_EQ(distinct.rows.size(), 200u);
  EXPECT_EQ(distinct.rows[0], 1);
  EXPECT_TRUE(std::is_sorted(distinct.rows.begin(), distinct.rows.end()));
}

TEST(FeatureTree, BlocksAreSmall)
{
  const Planted planted(
      made::onSurface(10, 33, 0.1, 1), made::onSurface(4096, 33, 0.1, 2), 2);
  const FeatureTree& tree = planted.trees[1];
  const auto extent = [](const ShadowBox& box) { return (box.high - box.low).sum(); };
  double sum = 0;
  for (std::size_t block = 0; block < tree.blocks(); ++block)
    sum += extent(tree.bounds(32 * block, 32 * block + 32));
  // 128 blocks on a surface of two dimensions: an eleventh as wide along either.
  EXPECT_LT(sum / static_cast<double>(tree.blocks()), 0.3 * extent(tree.boxes[0]));
}

TEST(ShadowBox, DistanceIsThatOfTheNearestCorners)
{
  const ShadowBox a{{0, 0, 0, 0}, {1, 1, 1, 1}};
  EXPECT_EQ(a.squaredDistance(a), 0);
  EXPECT_EQ(a.squaredDistance({{3, 0.5f, 1, -2}, {4, 2, 9, -1}}), 4 + 1);
  EXPECT_EQ(ShadowBox({{3, 0.5f, 1, -2}, {4, 2, 9, -1}}).squaredDistance(a), 4 + 1);
}

} // namespace
} // namespace pcl_flashreg
