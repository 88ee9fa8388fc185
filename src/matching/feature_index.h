// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "matching/cpu/feature_search.h"

#include <vector>

namespace pcl_flashreg {

/** \brief Descriptors made ready for being searched, any number of times. */
struct FeatureIndex {
  /** \brief What searches go through, in the order of its making. */
  DistinctFeatures features;
  FeatureSpace space;
  FeatureTree tree;
  TargetBlocks blocks;

  /** \param[in] targets at least one; those in the view must stay where they are */
  FeatureIndex(DistinctFeatures targets, ThreadPool& pool);

  FeatureIndex(DistinctFeatures distinct,
               FeatureSpace of_them,
               FeatureTree planted,
               TargetBlocks transposed);

  /** \brief As searchFeatures() with these targets, to the last bit. */
  std::vector<FeatureMatch>
  search(const FeatureView& queries, std::size_t k, ThreadPool& pool) const;

  /** \brief Of memory. */
  std::size_t
  bytes() const;
};

} // namespace pcl_flashreg
