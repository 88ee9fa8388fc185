// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "spread.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace pcl_flashreg::benchmark {

Spread
spreadOf(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  const auto at = [&](double quantile) {
    return values[static_cast<std::size_t>(
        std::lround(quantile * static_cast<double>(values.size() - 1)))];
  };
  return {at(0.5), at(0.1), at(0.9), values.front()};
}

Spread
spreadOf(const std::vector<StageTimings>& timings, double StageTimings::*milliseconds)
{
  std::vector<double> times;
  for (const StageTimings& t : timings)
    times.push_back(t.*milliseconds);
  return spreadOf(times);
}

} // namespace pcl_flashreg::benchmark
