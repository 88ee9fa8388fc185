// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "estimation/part.h"

#include "estimation/cpu/residual_test.h"

#include <algorithm>
#include <limits>

namespace pcl_flashreg {

void
takeRows(const Problem& problem,
         const std::vector<std::size_t>& rows,
         std::size_t most,
         Problem& part)
{
  const std::size_t count = std::min(most, rows.size());
  part.upright = problem.upright;
  part.resize(count);
  part.radius = problem.radius;
  const auto copy = [&](const AlignedBuffer<float>& from, AlignedBuffer<float>& to) {
    for (std::size_t k = 0; k < count; ++k)
      to[k] = from[rows[k * rows.size() / count]];
    std::fill(to.begin() + count, to.end(), std::numeric_limits<float>::quiet_NaN());
  };
  copy(problem.sx, part.sx);
  copy(problem.sy, part.sy);
  copy(problem.sz, part.sz);
  copy(problem.tx, part.tx);
  copy(problem.ty, part.ty);
  copy(problem.tz, part.tz);
  if (problem.upright.required)
    copy(problem.rise, part.rise);
}

void
takeLeftover(const Problem& problem,
             const Pose& pose,
             float limit,
             std::size_t most,
             Problem& leftover)
{
  const std::vector<int> explained =
      cpu::ResidualTest(cpu::usualKernels(), problem, limit).rows(toSingle(pose));
  std::vector<std::size_t> rows;
  std::size_t next = 0;
  for (std::size_t i = 0; i < problem.size; ++i)
    if (next < explained.size() && static_cast<std::size_t>(explained[next]) == i)
      ++next;
    else
      rows.push_back(i);
  takeRows(problem, rows, most, leftover);
}

} // namespace pcl_flashreg
