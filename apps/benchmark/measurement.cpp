// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "measurement.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::benchmark {
namespace {

constexpr int WARM_UP_RUNS = 3;

} // namespace

Spread
spreadOf(std::vector<double> times)
{
  std::sort(times.begin(), times.end());
  const auto at = [&](double quantile) {
    return times[static_cast<std::size_t>(
        std::lround(quantile * static_cast<double>(times.size() - 1)))];
  };
  return {at(0.5), at(0.1), at(0.9), times.front()};
}

Measurement
measure(const std::string& name,
        const CorrespondenceView<double>& correspondences,
        const Parameters& parameters,
        unsigned threads,
        int runs)
{
  Measurement measurement;
  measurement.name = name;
  measurement.size = correspondences.size;
  Estimator estimator(BackendKind::Auto, threads);
  measurement.result = estimator.estimate(correspondences, parameters);
  measurement.cold_ms = measurement.result.timings_ms.total;
  for (int i = 0; i < WARM_UP_RUNS; ++i)
    estimator.estimate(correspondences, parameters);

  std::vector<StageTimings> timings;
  for (int i = 0; i < runs; ++i)
    timings.push_back(estimator.estimate(correspondences, parameters).timings_ms);
  for (std::size_t s = 0; s < STAGES.size(); ++s) {
    std::vector<double> times;
    for (const StageTimings& t : timings)
      times.push_back(t.*STAGES[s].second);
    measurement.stages[s] = spreadOf(times);
  }
  return measurement;
}

} // namespace pcl_flashreg::benchmark
