// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "support/thread_pool.h"

#include <pcl_flashreg/feature_matching.h>

namespace pcl_flashreg {

/** \brief Whether a search can be made.
 * \throws std::invalid_argument as FeatureMatcher::match() */
void
checkSearch(const FeatureView& queries, const FeatureView& targets, std::size_t k);

/** \brief The k nearest target descriptors of each query, and with `both_ways` the other
 * way round, too; as FeatureMatcher states it.
 * \throws std::invalid_argument see there */
MutualMatches
searchFeatures(const FeatureView& queries,
               const FeatureView& targets,
               std::size_t k,
               bool both_ways,
               ThreadPool& pool);

} // namespace pcl_flashreg
