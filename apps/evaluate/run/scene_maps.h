// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../datasets/cloud_sets.h"
#include "../datasets/known_poses.h"
#include "../features/feature_store.h"
#include "../methods/method.h"
#include "../results/map_summary.h"
#include "job.h"

#include <pcl_flashreg/multiview_registration.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief The maps that whole sets of clouds make (cloudSets() of all pairs of the job), each
 * made when it is first asked for. */
class SceneMaps {
public:
  SceneMaps(const Options& options, const Job& job);

  /** \brief Where the map has the pair's clouds; not found if they are in different groups.
   * Clouds that do not overlap have no true pose: then only an edge between them counts.
   * \param[in,out] store has the scans; those of the whole set are taken from it */
  Answer
  answer(const Pair& pair, FeatureStore& store);

  /** \brief Of the maps that were made, in the order of the sets. */
  std::vector<MapSummary>
  summaries() const;

private:
  struct Map {
    MultiviewResult result;
    MapSummary summary;
  };

  const Map&
  mapOf(std::size_t set, FeatureStore& store);

  /** \brief Fills what is counted of edges. */
  void
  judgeEdges(const CloudSet& set, Map& map) const;

  const Job& job_;
  MultiviewOptions options_;
  MultiviewRegistration registration_;
  KnownPoses truth_;
  std::vector<CloudSet> sets_;
  /** \brief Of each cloud its set, and its number there. */
  std::map<std::string, std::pair<std::size_t, std::size_t>> places_;
  std::vector<std::optional<Map>> maps_;
};

} // namespace pcl_flashreg::evaluate
