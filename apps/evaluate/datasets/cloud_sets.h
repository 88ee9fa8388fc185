// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "pair.h"

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Clouds that belong together: those of a scene's pairs, and of all scenes, in other
 * data sets perhaps, that share a cloud with it. */
struct CloudSet {
  /** \brief The names of the scenes, as far as they differ. */
  std::string name;
  /** \brief Paths of the clouds, ascending. */
  std::vector<std::string> clouds;
};

/** \brief All clouds of the pairs, each in one set; the sets by their first pair. */
std::vector<CloudSet>
cloudSets(const std::vector<const Pair*>& pairs);

} // namespace pcl_flashreg::evaluate
