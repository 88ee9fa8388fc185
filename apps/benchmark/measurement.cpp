// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "measurement.h"

namespace pcl_flashreg::benchmark {

Measurement
measure(const std::string& name,
        const CorrespondenceView<double>& correspondences,
        const Parameters& parameters,
        BackendKind backend,
        unsigned threads,
        int runs)
{
  Measurement measurement;
  measurement.name = name;
  measurement.size = correspondences.size;
  Estimator estimator(backend, threads);
  measurement.result = estimator.estimate(correspondences, parameters);
  measurement.cold_ms = measurement.result.timings_ms.total;
  for (int i = 0; i < WARM_UP_RUNS; ++i)
    estimator.estimate(correspondences, parameters);

  std::vector<StageTimings> timings;
  for (int i = 0; i < runs; ++i)
    timings.push_back(estimator.estimate(correspondences, parameters).timings_ms);
  const auto spread = [&](double StageTimings::*milliseconds) {
    std::vector<double> times;
    for (const StageTimings& t : timings)
      times.push_back(t.*milliseconds);
    return spreadOf(times);
  };
  for (std::size_t s = 0; s < STAGES.size(); ++s)
    measurement.stages[s] = spread(STAGES[s].milliseconds);
  measurement.total = spread(&StageTimings::total);
  return measurement;
}

} // namespace pcl_flashreg::benchmark
