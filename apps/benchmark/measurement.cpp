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
        const Repetition& repetition)
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
  const detail::Stopwatch stopwatch;
  for (int i = 0; !repetition.isOver(i, stopwatch); ++i)
    timings.push_back(estimator.estimate(correspondences, parameters).timings_ms);
  for (std::size_t s = 0; s < STAGES.size(); ++s)
    measurement.stages[s] = spreadOf(timings, STAGES[s].milliseconds);
  measurement.total = spreadOf(timings, &StageTimings::total);
  return measurement;
}

} // namespace pcl_flashreg::benchmark
