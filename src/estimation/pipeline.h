// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "estimation/problem.h"
#include "support/stage_clock.h"
#include "estimation/trace.h"

#include <pcl_flashreg/parameters.h>
#include <pcl_flashreg/result.h>

#include <optional>
#include <vector>

namespace pcl_flashreg {

/** \brief What the stages found, in the centred frames. */
struct PoseEstimate {
  Status status = Status::NoClique;
  SecondOrder second_order = SecondOrder::Exact;
  /** \brief Distinct hypotheses, refined, best first; empty unless status is Ok. */
  std::vector<ScoredPose> hypotheses;
  /** \brief Rows of the problem that agree with the first, ascending. */
  std::vector<int> inliers;
  /** \brief Every hypothesis that was verified, as it was, in clique order and the guess
   * last; empty unless asked for. */
  std::vector<Pose> candidates;
  /** \brief Cliques of the best pivots, for what poses don't say: those in the first
   * LISTED_CLIQUES places, of which each pivot has Parameters::cliques_per_pivot. Empty unless
   * status is Ok. */
  std::vector<Clique> cliques;
};

/** \brief The method, once for every backend (docs/method.md): stages 1 to 7.
 *
 * \tparam Stages a backend's buffers and its form of every stage; a stage reads what the
 * ones before it left there. It may return before its work is done; finish() marks its end.
 * settled() waits for the work, and tells whether stage 2 had the buffers that this input
 * needs: a device finds out when it is too late to ask the host for others.
 * \param[in] guess a pose in the centred frames that is verified with the others
 * \param[in] with_candidates whether PoseEstimate::candidates is wanted
 */
template <typename Stages>
PoseEstimate
runPipeline(Stages& stages,
            const Problem& problem,
            const Parameters& parameters,
            const std::optional<Pose>& guess,
            bool with_candidates,
            StageClock& clock,
            Trace* trace)
{
  stages.begin(problem, parameters, guess, clock);

  stages.firstOrderGraph(); // Eq. (dis), (fog)
  stages.finish(&StageTimings::first_order_graph);

  do {
    stages.secondOrderGraph(); // Eq. (sog), (sog_trunc), (ell_sog)
    stages.finish(&StageTimings::second_order_graph);

    stages.pivots(); // Eq. (pivot), Alg. 1 phase 1
    stages.finish(&StageTimings::pivots);

    stages.cliques(); // Eq. (common), (clique), Alg. 1 phase 2
    stages.finish(&StageTimings::cliques);

    stages.hypotheses(); // three-point alignment
    stages.finish(&StageTimings::hypotheses);

    stages.verification(); // residuals of all correspondences
    stages.finish(&StageTimings::verification);

    stages.refinement(); // reweighted alignment, Eq. (objective)
    stages.finish(&StageTimings::refinement);
  } while (!stages.settled());

  if (trace)
    stages.copyTo(*trace);
  PoseEstimate estimate = stages.result();
  if (with_candidates)
    estimate.candidates = stages.candidates();
  return estimate;
}

} // namespace pcl_flashreg
