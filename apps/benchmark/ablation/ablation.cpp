// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ablation.h"

#include "ablation_stages.h"

#include <cstdio>

namespace pcl_flashreg::benchmark {
namespace {

AblationMeasurement
measureRow(const AblationRow& row,
           const Problem& problem,
           const Parameters& parameters,
           const Repetition& repetition)
{
  AblationMeasurement measurement;
  measurement.row = row;
  AblationStages stages(row);
  std::vector<StageTimings> timings;
  const detail::Stopwatch stopwatch;
  for (int i = -WARM_UP_RUNS; !repetition.isOver(i, stopwatch); ++i) {
    StageTimings t;
    StageClock clock(t);
    const PoseEstimate estimate =
        runPipeline(stages, problem, parameters, std::nullopt, false, clock, nullptr);
    measurement.inliers = estimate.inliers.size();
    // Stages follow each other without a gap.
    for (std::size_t s = 0; s + 1 < ABLATION_STAGES.size(); ++s)
      t.total += t.*ABLATION_STAGES[s].milliseconds;
    if (i >= 0)
      timings.push_back(t);
  }
  for (std::size_t s = 0; s < ABLATION_STAGES.size(); ++s)
    measurement.stages[s] = spreadOf(timings, ABLATION_STAGES[s].milliseconds);
  measurement.device_bytes = stages.deviceBytes();
  return measurement;
}

} // namespace

std::vector<AblationMeasurement>
measureAblation(const Problem& problem,
                const Parameters& parameters,
                const Repetition& repetition)
{
  std::vector<AblationMeasurement> measurements;
  for (const AblationRow& row : ablationRows())
    measurements.push_back(measureRow(row, problem, parameters, repetition));
  return measurements;
}

void
printAblation(const std::vector<AblationMeasurement>& measurements)
{
  std::printf("%-28s", "ablation (median ms)");
  for (const char* column : {"graph 1",
                             "graph 2",
                             "pivots",
                             "cliques",
                             "hypoth.",
                             "verif.",
                             "refine.",
                             "total"})
    std::printf(" %8s", column);
  std::printf(" %8s %8s\n", "inliers", "MB");
  for (const AblationMeasurement& m : measurements) {
    std::printf("%-28s", m.row.name.c_str());
    for (std::size_t s = 0; s < m.stages.size(); ++s)
      if (ABLATION_STAGES[s].milliseconds == &StageTimings::pivots &&
          m.row.pivotsInSecondOrder())
        std::printf(" %8s", "--");
      else
        std::printf(" %8.3f", m.stages[s].median);
    std::printf(" %8zu %8.1f\n", m.inliers, 1e-6 * static_cast<double>(m.device_bytes));
  }
}

} // namespace pcl_flashreg::benchmark
