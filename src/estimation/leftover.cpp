// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/leftover.h"

#include "math/residual.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace pcl_flashreg {

void
takeLeftover(const Problem& problem,
             const Pose& pose,
             float limit,
             std::size_t most,
             Problem& leftover)
{
  const PoseF single = toSingle(pose);
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < problem.size; ++i)
    if (!(squaredResidual(single, problem.pair(i)) < limit * limit))
      rows.push_back(i);
  const std::size_t count = std::min(most, rows.size());
  leftover.upright = problem.upright;
  leftover.resize(count);
  leftover.radius = problem.radius;
  const auto copy = [&](const AlignedBuffer<float>& from, AlignedBuffer<float>& to) {
    for (std::size_t k = 0; k < count; ++k)
      to[k] = from[rows[k * rows.size() / count]];
    std::fill(to.begin() + count, to.end(), std::numeric_limits<float>::quiet_NaN());
  };
  copy(problem.sx, leftover.sx);
  copy(problem.sy, leftover.sy);
  copy(problem.sz, leftover.sz);
  copy(problem.tx, leftover.tx);
  copy(problem.ty, leftover.ty);
  copy(problem.tz, leftover.tz);
  if (problem.upright.required)
    copy(problem.rise, leftover.rise);
}

} // namespace pcl_flashreg
