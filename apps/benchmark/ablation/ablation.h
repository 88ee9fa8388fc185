// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../repetition.h"
#include "../spread.h"
#include "ablation_row.h"
#include "estimation/problem.h"

#include <pcl_flashreg/parameters.h>
#include <pcl_flashreg/stage_timings.h>

#include <array>
#include <vector>

namespace pcl_flashreg::benchmark {

/** \brief The stages of a row in order, the total last. */
constexpr std::array<Stage, 8> ABLATION_STAGES = {{
    {"first_order_graph", &StageTimings::first_order_graph},
    {"second_order_graph", &StageTimings::second_order_graph},
    {"pivots", &StageTimings::pivots},
    {"cliques", &StageTimings::cliques},
    {"hypotheses", &StageTimings::hypotheses},
    {"verification", &StageTimings::verification},
    {"refinement", &StageTimings::refinement},
    {"total", &StageTimings::total},
}};

/** \brief A row, timed on one problem. */
struct AblationMeasurement {
  AblationRow row;
  /** \brief By the device's clock, from the first stage's start to the last one's end; the
   * way of the coordinates to the device and of the result back is not in it. Pivots are 0
   * where AblationRow::pivotsInSecondOrder(). */
  std::array<Spread, ABLATION_STAGES.size()> stages;
  /** \brief Of the pose in the end. */
  std::size_t inliers = 0;
  /** \brief Device memory of this row's buffers at most. */
  std::size_t device_bytes = 0;
};

/** \brief Times every row of the ablation.
 * \param[in] repetition of a row's calls, after some that are not counted
 * \throws BackendError if there is no device, or a row doesn't fit into its memory
 */
std::vector<AblationMeasurement>
measureAblation(const Problem& problem,
                const Parameters& parameters,
                const Repetition& repetition);

/** \brief A table on the standard output, medians in milliseconds. */
void
printAblation(const std::vector<AblationMeasurement>& measurements);

} // namespace pcl_flashreg::benchmark
