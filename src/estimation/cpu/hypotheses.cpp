// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 5: one rigid transform a clique, and the caller's guess behind them.

#include "estimation/cpu/stages.h"
#include "math/triplet_alignment.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cpu {

void
Stages::hypotheses()
{
  constexpr std::size_t CLIQUES_A_TASK = 256;
  const std::size_t count = cliques_.size() + (guess_ ? 1 : 0);
  poses_.resize(count);
  pose_valid_.assign(count, 0);
  const std::size_t tasks = (cliques_.size() + CLIQUES_A_TASK - 1) / CLIQUES_A_TASK;
  pool_.forEach(tasks, [&](std::size_t task, std::size_t) {
    const std::size_t end = std::min(cliques_.size(), (task + 1) * CLIQUES_A_TASK);
    for (std::size_t i = task * CLIQUES_A_TASK; i < end; ++i) {
      const Clique& c = cliques_[i];
      const Problem& p = *problem_;
      const Vec3 source[3] = {p.source(c.u), p.source(c.v), p.source(c.w)};
      const Vec3 target[3] = {p.target(c.u), p.target(c.v), p.target(c.w)};
      pose_valid_[i] = alignTriplet(source, target, p.upright, poses_[i]);
    }
  });
  if (guess_) {
    poses_.back() = *guess_;
    pose_valid_.back() = 1;
  }
}

/** \brief The valid ones, in order. */
std::vector<Pose>
Stages::candidates() const
{
  std::vector<Pose> valid;
  for (std::size_t i = 0; i < poses_.size(); ++i)
    if (pose_valid_[i])
      valid.push_back(poses_[i]);
  return valid;
}

} // namespace cpu
} // namespace pcl_flashreg
