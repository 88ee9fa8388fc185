// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <array>

namespace pcl_flashreg {

/** \brief Wall-clock time of each stage in milliseconds; the names are METHOD's. */
struct StageTimings {
  /** \brief Checking, ranking, centring and packing the input. */
  double preparation = 0;
  double first_order_graph = 0;
  double second_order_graph = 0;
  double pivots = 0;
  double cliques = 0;
  double hypotheses = 0;
  double verification = 0;
  double refinement = 0;
  /** \brief Bringing the hypotheses before the clouds, where there are any, and putting the
   * result together. */
  double cloud_check = 0;
  /** \brief More correspondences, and what they speak for brought before the clouds, where
   * the first left doubt. */
  double second_look = 0;
  /** \brief The whole call. */
  double total = 0;
};

/** \brief A stage's name, and where its time stands. */
struct Stage {
  const char* name;
  double StageTimings::*milliseconds;
};

/** \brief All stages in their order: what reports list, and what adds up to the total. */
inline constexpr std::array<Stage, 10> STAGES = {{
    {"preparation", &StageTimings::preparation},
    {"first_order_graph", &StageTimings::first_order_graph},
    {"second_order_graph", &StageTimings::second_order_graph},
    {"pivots", &StageTimings::pivots},
    {"cliques", &StageTimings::cliques},
    {"hypotheses", &StageTimings::hypotheses},
    {"verification", &StageTimings::verification},
    {"refinement", &StageTimings::refinement},
    {"cloud_check", &StageTimings::cloud_check},
    {"second_look", &StageTimings::second_look},
}};

} // namespace pcl_flashreg
