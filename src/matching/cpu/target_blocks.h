// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "matching/cpu/feature_tree.h"
#include "simd/kernels.h"
#include "support/aligned_buffer.h"

#include <cstddef>
#include <memory>

namespace pcl_flashreg {

/** \brief One side of a search. */
struct FeatureSet {
  const DistinctFeatures& features;
  const FeatureTree& tree;
};

/** \brief Squared length of a row of a block. */
double
squaredNorm(const float* values, std::size_t n);

/** \brief The targets of a search, centred and transposed in blocks, with their norms. */
class TargetBlocks {
public:
  TargetBlocks() = default;
  TargetBlocks(const FeatureSet& targets, const FeatureSpace& space, ThreadPool& pool);

  /** \brief Those that were made before: what values(), norms() and longest() gave out.
   * \param[in] keeper has their memory, which begins at multiples of 64 bytes, as long as it
   * lives */
  TargetBlocks(std::shared_ptr<const void> keeper,
               const float* values,
               const float* norms,
               std::size_t blocks,
               std::size_t dimension,
               double longest);

  cpu::FeatureBlock
  input() const
  {
    return {values_, norms_, dimension_};
  }

  std::size_t
  blocks() const
  {
    return blocks_;
  }

  /** \brief The largest length of a centred and scaled target. */
  double
  longest() const
  {
    return longest_;
  }

private:
  void
  fill(std::size_t block,
       const FeatureSet& targets,
       const FeatureSpace& space,
       float* values,
       float* norms) const;

  std::shared_ptr<const void> keeper_;
  const float* values_ = nullptr;
  const float* norms_ = nullptr;
  std::size_t blocks_ = 0, dimension_ = 0;
  double longest_ = 0;
};

} // namespace pcl_flashreg
