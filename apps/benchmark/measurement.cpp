// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "measurement.h"

#include <algorithm>

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

Throughput
measureThroughput(const CorrespondenceView<double>& correspondences,
                  const Parameters& parameters,
                  BackendKind backend,
                  unsigned side_by_side,
                  const Repetition& repetition)
{
  // So many rounds that nobody waits for the last one for long.
  constexpr int ROUNDS = 8;
  const std::vector<CorrespondenceView<double>> batch(
      static_cast<std::size_t>(std::min(ROUNDS, repetition.runs)) * side_by_side,
      correspondences);
  Estimator estimator(backend, side_by_side);
  estimator.estimateBatch(batch, parameters);
  const detail::Stopwatch stopwatch;
  int done = 0;
  for (; !repetition.isOver(done, stopwatch); done += static_cast<int>(batch.size()))
    estimator.estimateBatch(batch, parameters);
  return {side_by_side, 1e3 * done / stopwatch.milliseconds()};
}

} // namespace pcl_flashreg::benchmark
