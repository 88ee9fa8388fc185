// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/thread_pool.h"
#include "matching/cpu/feature_space.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief Bounds of some shadows. */
struct ShadowBox {
  Shadow low, high;

  /** \brief Squared distance of the nearest shadows that both could hold. */
  float
  squaredDistance(const ShadowBox& other) const
  {
    return (low - other.high).max(other.low - high).max(0.0f).square().sum();
  }
};

/** \brief A set of descriptors in the order of a k-d tree of their shadows. The tree halves
 * blocks of FEATURE_BLOCK; within a block, QUERY_BLOCK by QUERY_BLOCK are near each other,
 * too.
 *
 * Nodes are numbered in preorder: that of blocks [begin, end) is followed by its left child,
 * [begin, middle(begin, end)), and that by what is below it.
 */
struct FeatureTree {
  /** \brief Which of the descriptors each is. */
  std::vector<std::int32_t> order;
  /** \brief Their shadows, in that order. */
  std::vector<Shadow> shadows;
  /** \brief A box each node. */
  std::vector<ShadowBox> boxes;

  std::size_t
  blocks() const
  {
    return (boxes.size() + 1) / 2;
  }

  static std::size_t
  middle(std::size_t begin, std::size_t end)
  {
    return begin + (end - begin) / 2;
  }

  /** \brief The child of a node that has the blocks from the middle on. */
  static std::size_t
  rightChild(std::size_t node, std::size_t begin, std::size_t end)
  {
    return node + 2 * (middle(begin, end) - begin);
  }

  /** \brief Bounds of the shadows at [begin, end). */
  ShadowBox
  bounds(std::size_t begin, std::size_t end) const;
};

/** \brief The trees of the sets of a search, none of which is empty. */
std::vector<FeatureTree>
plantTrees(const std::vector<const DistinctFeatures*>& features,
           const FeatureSpace& space,
           ThreadPool& pool);

} // namespace pcl_flashreg
