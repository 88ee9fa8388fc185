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

} // namespace pcl_flashreg::benchmark
