// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "matching/cpu/distinct_features.h"
#include "matching/cpu/nearest_lists.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pcl_flashreg {

/** \brief The matches of all queries, made from those of the distinct ones: equal queries
 * share them, and equal targets follow each other in them. */
class MatchTable {
public:
  /** \param[in] k matches a query; fewer where there are fewer targets */
  MatchTable(const DistinctFeatures& queries,
             const DistinctFeatures& targets,
             std::size_t k);

  /** \brief Enters the nearest distinct targets of a distinct query, best first: k of
   * them, or all. Different queries may be entered at a time. */
  void
  enter(std::size_t query, const Candidate* begin, const Candidate* end);

  /** \brief As FeatureMatcher::match() states them, once all queries are entered. */
  std::vector<FeatureMatch>
  take();

private:
  /** \brief Appends targets that are equally far, and those that equal them, by index, as
   * far as there is room.
   * \return behind the last */
  FeatureMatch*
  append(std::int32_t query,
         const Candidate* begin,
         const Candidate* end,
         FeatureMatch* at,
         const FeatureMatch* full) const;

  const DistinctFeatures& queries_;
  const DistinctFeatures& targets_;
  std::size_t length_;
  std::vector<FeatureMatch> matches_;
};

} // namespace pcl_flashreg
