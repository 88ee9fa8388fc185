// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/cpu/feature_tree.h"

#include "simd/kernels.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace pcl_flashreg {
namespace {

using cpu::FEATURE_BLOCK;
using cpu::QUERY_BLOCK;

/** \brief Descriptors that a task casts the shadows of. */
constexpr std::size_t CAST_AT_ONCE = 128;
/** \brief Shadows, at most nearly, that say along which axis a node is halved. */
constexpr std::size_t SAMPLES = 64;

/** \brief Sorts one set. Nodes that don't contain each other can be halved at a time. */
class Planter {
public:
  explicit Planter(FeatureTree& tree) : tree_(tree), entries_(tree.shadows.size())
  {
    const std::size_t size = tree.shadows.size();
    tree.order.resize(size);
    std::iota(tree.order.begin(), tree.order.end(), 0);
    const std::size_t blocks = (size + FEATURE_BLOCK - 1) / FEATURE_BLOCK;
    tree.boxes.resize(2 * blocks - 1);
  }

  /** \brief Bounds a node, and sorts its descriptors into its children. */
  void
  split(std::size_t node, std::size_t begin, std::size_t end)
  {
    const std::size_t first = begin * FEATURE_BLOCK;
    const std::size_t last = std::min(end * FEATURE_BLOCK, tree_.order.size());
    tree_.boxes[node] = tree_.bounds(first, last);
    if (end - begin > 1)
      halve(first, FeatureTree::middle(begin, end) * FEATURE_BLOCK, last);
    else
      sortBlock(first, last);
  }

  /** \brief The same for all nodes below, too. */
  void
  splitAll(std::size_t node, std::size_t begin, std::size_t end)
  {
    split(node, begin, end);
    if (end - begin == 1)
      return;
    const std::size_t middle = FeatureTree::middle(begin, end);
    splitAll(node + 1, begin, middle);
    splitAll(FeatureTree::rightChild(node, begin, end), middle, end);
  }

private:
  struct Entry {
    float key;
    std::int32_t index;
    Shadow shadow;
  };

  /** \brief The axis along which shadows vary most. */
  Eigen::Index
  widestAxis(std::size_t first, std::size_t last) const
  {
    const std::size_t step = (last - first + SAMPLES - 1) / SAMPLES;
    const Shadow origin = tree_.shadows[first];
    Shadow sum = Shadow::Zero(), squares = Shadow::Zero();
    float count = 0;
    for (std::size_t i = first; i < last; i += step, ++count) {
      const Shadow offset = tree_.shadows[i] - origin;
      sum += offset;
      squares += offset.square();
    }
    Eigen::Index axis = 0;
    (squares - sum.square() / count).maxCoeff(&axis);
    return axis;
  }

  /** \brief Those before the middle are not above those from there on. */
  void
  halve(std::size_t first, std::size_t middle, std::size_t last)
  {
    const Eigen::Index axis = widestAxis(first, last);
    for (std::size_t i = first; i < last; ++i)
      entries_[i] = {tree_.shadows[i][axis], tree_.order[i], tree_.shadows[i]};
    const auto at = [&](std::size_t i) {
      return entries_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(first), at(middle), at(last), [](const auto& a, const auto& b) {
      return a.key < b.key;
    });
    for (std::size_t i = first; i < last; ++i) {
      tree_.order[i] = entries_[i].index;
      tree_.shadows[i] = entries_[i].shadow;
    }
  }

  void
  sortBlock(std::size_t first, std::size_t last)
  {
    const std::size_t groups = (last - first + QUERY_BLOCK - 1) / QUERY_BLOCK;
    if (groups < 2)
      return;
    const std::size_t middle = first + groups / 2 * QUERY_BLOCK;
    halve(first, middle, last);
    sortBlock(first, middle);
    sortBlock(middle, last);
  }

  FeatureTree& tree_;
  std::vector<Entry> entries_;
};

/** \brief A node of one of the trees that is still to be split. */
struct Task {
  std::size_t tree, node, begin, end;
};

void
castShadows(const std::vector<const DistinctFeatures*>& features,
            const FeatureSpace& space,
            std::vector<FeatureTree>& trees,
            ThreadPool& pool)
{
  struct Share {
    std::size_t tree, begin;
  };
  std::vector<Share> shares;
  for (std::size_t t = 0; t < features.size(); ++t) {
    trees[t].shadows.resize(features[t]->size());
    for (std::size_t begin = 0; begin < features[t]->size(); begin += CAST_AT_ONCE)
      shares.push_back({t, begin});
  }
  pool.forEach(shares.size(), [&](std::size_t i, std::size_t) {
    const auto [t, begin] = shares[i];
    const std::size_t end = std::min(begin + CAST_AT_ONCE, features[t]->size());
    space.cast(*features[t], begin, end, trees[t].shadows.data());
  });
}

} // namespace

ShadowBox
FeatureTree::bounds(std::size_t begin, std::size_t end) const
{
  ShadowBox box{shadows[begin], shadows[begin]};
  for (std::size_t i = begin + 1; i < end; ++i) {
    box.low = box.low.min(shadows[i]);
    box.high = box.high.max(shadows[i]);
  }
  return box;
}

std::vector<FeatureTree>
plantTrees(const std::vector<const DistinctFeatures*>& features,
           const FeatureSpace& space,
           ThreadPool& pool)
{
  std::vector<FeatureTree> trees(features.size());
  castShadows(features, space, trees, pool);
  std::vector<Planter> planters;
  std::vector<Task> tasks;
  for (std::size_t t = 0; t < trees.size(); ++t) {
    planters.emplace_back(trees[t]);
    tasks.push_back({t, 0, 0, trees[t].blocks()});
  }
  // Level by level, until there are nodes enough for all threads.
  while (tasks.size() < 4 * pool.size()) {
    pool.forEach(tasks.size(), [&](std::size_t i, std::size_t) {
      const Task& task = tasks[i];
      planters[task.tree].split(task.node, task.begin, task.end);
    });
    std::vector<Task> children;
    for (const auto& [tree, node, begin, end] : tasks) {
      if (end - begin == 1)
        continue;
      const std::size_t middle = FeatureTree::middle(begin, end);
      children.push_back({tree, node + 1, begin, middle});
      children.push_back(
          {tree, FeatureTree::rightChild(node, begin, end), middle, end});
    }
    tasks = std::move(children);
    if (tasks.empty())
      break;
  }
  pool.forEach(tasks.size(), [&](std::size_t i, std::size_t) {
    const Task& task = tasks[i];
    planters[task.tree].splitAll(task.node, task.begin, task.end);
  });
  return trees;
}

} // namespace pcl_flashreg
