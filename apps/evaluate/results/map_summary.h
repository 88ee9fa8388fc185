// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief What became of a set of clouds that were registered with each other. */
struct MapSummary {
  /** \brief CloudSet::name */
  std::string name;
  std::size_t scans = 0;
  /** \brief Those that are in a group with others, and such groups. */
  std::size_t placed = 0, groups = 0;
  /** \brief Pairs that were tried. */
  std::size_t tried = 0;
  std::size_t used_edges = 0;
  /** \brief Used edges whose pose in the map is off by more than the criterion's rotation, or
   * twice its translation; and those of which no truth is known. */
  std::size_t wrong_edges = 0, unknown_edges = 0;
  /** \brief From scans with descriptors to the map. */
  double seconds = 0;
};

/** \brief A table for people; empty where there is no map. */
std::string
formatMaps(const std::vector<MapSummary>& maps);

} // namespace pcl_flashreg::evaluate
