// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "matching/cpu/feature_tree.h"

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief One side of a search. */
struct FeatureSet {
  const DistinctFeatures& features;
  const FeatureTree& tree;
};

/** \brief The k nearest targets of each query, as FeatureMatcher::match() states them.
 * Neither set is empty. */
std::vector<FeatureMatch>
searchNearest(const FeatureSet& queries,
              const FeatureSet& targets,
              const FeatureSpace& space,
              std::size_t k,
              ThreadPool& pool);

} // namespace pcl_flashreg
