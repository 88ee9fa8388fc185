// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "matching/cpu/feature_tree.h"
#include "matching/cpu/target_blocks.h"

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief The k nearest targets of each query, as FeatureMatcher::match() states them.
 * Neither set is empty. */
std::vector<FeatureMatch>
searchNearest(const FeatureSet& queries,
              const FeatureSet& targets,
              const TargetBlocks& blocks,
              const FeatureSpace& space,
              std::size_t k,
              ThreadPool& pool);

} // namespace pcl_flashreg
