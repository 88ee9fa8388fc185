// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/export.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pcl_flashreg {

/** \brief Descriptors as rows of floats; nothing is copied or owned. */
struct FeatureView {
  /** \brief First value of the first descriptor. */
  const float* data = nullptr;
  /** \brief Number of descriptors. */
  std::size_t size = 0;
  /** \brief Values in a descriptor. */
  std::size_t dimension = 0;
  /** \brief Floats from one descriptor to the next, >= dimension. */
  std::size_t stride = 0;
};

/** \brief A query descriptor and one of its nearest target descriptors. */
struct FeatureMatch {
  std::int32_t query;
  std::int32_t match;
  /** \brief Squared Euclidean distance in feature space. */
  float squared_distance;
};

/** \brief Matches from one search in both directions. */
struct MutualMatches {
  /** \brief As FeatureMatcher::match(queries, targets) gives them. */
  std::vector<FeatureMatch> forward;
  /** \brief As FeatureMatcher::match(targets, queries) gives them: `query` is a target
   * here. */
  std::vector<FeatureMatch> backward;

  /** \brief Those of `forward` that are in `backward`, too; in order. */
  PCL_FLASHREG_EXPORT std::vector<FeatureMatch>
  mutual() const;
};

/** \brief Nearest neighbours among descriptors: those of an exhaustive search in double
 * precision.
 *
 * The same on every SIMD variant and number of threads. Memory grows with the number of
 * descriptors. Keeps its threads from call to call; an object is not to be used by two
 * threads at a time; after a fork(), as Estimator.
 */
class PCL_FLASHREG_EXPORT FeatureMatcher {
public:
  /** \param[in] num_threads CPU threads; 0 takes as many as there are processors */
  explicit FeatureMatcher(unsigned num_threads = 0);
  ~FeatureMatcher();
  FeatureMatcher(FeatureMatcher&&) noexcept;
  FeatureMatcher&
  operator=(FeatureMatcher&&) noexcept;

  /** \brief The k nearest target descriptors of each query descriptor.
   *
   * Rows are ordered by query, then distance, then target index; ties go to the smaller
   * target index. Descriptors with a value that is not finite are skipped on both sides.
   * \param[in] queries descriptors to find matches for
   * \param[in] targets descriptors to search; same dimension
   * \param[in] k matches a query, >= 1; fewer where there are fewer targets
   * \throws std::invalid_argument if the dimensions differ, a stride is below the
   * dimension, k is 0 or a size does not fit 31 bits
   */
  std::vector<FeatureMatch>
  match(const FeatureView& queries, const FeatureView& targets, std::size_t k = 1);

  /** \brief match() in both directions, which share their preparation. With k = 2 the two
   * rows of a query are what a ratio test compares.
   * \throws std::invalid_argument as match()
   */
  MutualMatches
  matchBothWays(const FeatureView& queries,
                const FeatureView& targets,
                std::size_t k = 1);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/** \brief FeatureMatcher::match() with threads of its own. */
PCL_FLASHREG_EXPORT std::vector<FeatureMatch>
matchFeatures(const FeatureView& queries,
              const FeatureView& targets,
              std::size_t k = 1,
              unsigned num_threads = 0);

/** \brief FeatureMatcher::matchBothWays() with threads of its own. */
PCL_FLASHREG_EXPORT MutualMatches
matchFeaturesBothWays(const FeatureView& queries,
                      const FeatureView& targets,
                      std::size_t k = 1,
                      unsigned num_threads = 0);

} // namespace pcl_flashreg
