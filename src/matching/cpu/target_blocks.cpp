// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/cpu/target_blocks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pcl_flashreg {
namespace {

using cpu::FEATURE_BLOCK;

/** \brief Blocks of targets that a task transposes. */
constexpr std::size_t BLOCKS_A_TASK = 8;

struct Memory {
  AlignedBuffer<float> values, norms;
};

} // namespace

double
squaredNorm(const float* values, std::size_t n)
{
  double sum = 0;
  for (std::size_t d = 0; d < n; ++d)
    sum += static_cast<double>(values[d]) * values[d];
  return sum;
}

TargetBlocks::TargetBlocks(const FeatureSet& targets,
                           const FeatureSpace& space,
                           ThreadPool& pool)
    : blocks_(targets.tree.blocks()), dimension_(space.dimension())
{
  const auto memory = std::make_shared<Memory>();
  AlignedBuffer<float>&values = memory->values, &norms = memory->norms;
  const std::size_t size = targets.features.size();
  values.resize(blocks_ * dimension_ * FEATURE_BLOCK);
  norms.resize(blocks_ * FEATURE_BLOCK);
  const std::size_t tasks = (blocks_ + BLOCKS_A_TASK - 1) / BLOCKS_A_TASK;
  pool.forEach(tasks, [&](std::size_t task, std::size_t) {
    const std::size_t end = std::min(blocks_, (task + 1) * BLOCKS_A_TASK);
    for (std::size_t block = task * BLOCKS_A_TASK; block < end; ++block)
      fill(block, targets, space, values.data(), norms.data());
  });
  const float largest_norm = *std::max_element(norms.begin(), norms.begin() + size);
  longest_ = std::sqrt(static_cast<double>(largest_norm));
  values_ = values.data();
  norms_ = norms.data();
  keeper_ = memory;
}

TargetBlocks::TargetBlocks(std::shared_ptr<const void> keeper,
                           const float* values,
                           const float* norms,
                           std::size_t blocks,
                           std::size_t dimension,
                           double longest)
    : keeper_(std::move(keeper)),
      values_(values),
      norms_(norms),
      blocks_(blocks),
      dimension_(dimension),
      longest_(longest)
{
}

void
TargetBlocks::fill(std::size_t block,
                   const FeatureSet& targets,
                   const FeatureSpace& space,
                   float* values,
                   float* norms) const
{
  std::vector<float> centred(dimension_);
  for (std::size_t lane = 0; lane < FEATURE_BLOCK; ++lane) {
    const std::size_t i = block * FEATURE_BLOCK + lane;
    const bool is_target = i < targets.features.size();
    if (is_target)
      space.centre(targets.features[static_cast<std::size_t>(targets.tree.order[i])],
                   centred.data());
    else
      std::fill(centred.begin(), centred.end(), 0.0f);
    norms[i] = is_target ? static_cast<float>(squaredNorm(centred.data(), dimension_))
                         : std::numeric_limits<float>::infinity();
    for (std::size_t d = 0; d < dimension_; ++d)
      values[(block * dimension_ + d) * FEATURE_BLOCK + lane] = centred[d];
  }
}

} // namespace pcl_flashreg
