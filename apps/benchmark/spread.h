// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/stage_timings.h>

#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief Of repeated measurements: median, 10th and 90th percentile, least. */
struct Spread {
  double median = 0, p10 = 0, p90 = 0, least = 0;
};

/** \param[in] values at least one */
Spread
spreadOf(std::vector<double> values);

/** \brief Of one stage, or the total, over repeated calls. */
Spread
spreadOf(const std::vector<StageTimings>& timings, double StageTimings::*milliseconds);

/** \brief Calls that are made before any is counted. */
constexpr int WARM_UP_RUNS = 3;

} // namespace pcl_flashreg::benchmark
