// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/feature_index.h"

#include "matching/search.h"

#include <utility>

namespace pcl_flashreg {

FeatureIndex::FeatureIndex(DistinctFeatures targets, ThreadPool& pool)
    : features(std::move(targets)),
      space(features, features),
      tree(std::move(plantTrees({&features}, space, pool).front())),
      blocks({features, tree}, space, pool)
{
}

FeatureIndex::FeatureIndex(DistinctFeatures distinct,
                           FeatureSpace of_them,
                           FeatureTree planted,
                           TargetBlocks transposed)
    : features(std::move(distinct)),
      space(std::move(of_them)),
      tree(std::move(planted)),
      blocks(std::move(transposed))
{
}

std::vector<FeatureMatch>
FeatureIndex::search(const FeatureView& queries, std::size_t k, ThreadPool& pool) const
{
  checkSearch(queries, features.view, k);
  if (queries.size == 0)
    return {};
  const DistinctFeatures from(queries);
  if (from.size() == 0)
    return {};
  if (!space.hasRoomFor(from))
    return searchFeatures(queries, features.view, k, false, pool).forward;
  const FeatureTree queries_tree = plantTrees({&from}, space, pool).front();
  return searchNearest({from, queries_tree}, {features, tree}, blocks, space, k, pool);
}

std::size_t
FeatureIndex::bytes() const
{
  const std::size_t rows = features.finite.capacity() + features.rows.capacity() +
                           tree.order.capacity() + features.equal.firsts().capacity() +
                           features.equal.followers().capacity();
  const std::size_t padded = blocks.blocks() * cpu::FEATURE_BLOCK;
  return rows * sizeof(std::int32_t) + tree.shadows.capacity() * sizeof(Shadow) +
         tree.boxes.capacity() * sizeof(ShadowBox) +
         padded * (blocks.input().dimension + 1) * sizeof(float);
}

} // namespace pcl_flashreg
