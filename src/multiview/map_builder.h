// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/grouping.h"
#include "multiview/map_scans.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief Makes a map of what pairs of scans say, of which there is more with every round. */
class MapBuilder {
public:
  /** \brief Asks for every scan once, and for some of them again later. */
  MapBuilder(std::size_t count,
             MultiviewRegistration::ScanSource scans,
             double min_confidence,
             ThreadPool& pool);

  /** \throws std::invalid_argument if a relation names a scan that is none, or if two are of
   * the same source and target */
  void
  add(std::vector<ScanRelation> relations);

  const std::vector<ScanRelation>&
  relations() const
  {
    return relations_;
  }

  /** \brief Groups the scans by all relations, from nothing: the result depends on which there
   * are, and not on the order in which they came. */
  void
  group();

  /** \brief Of the last group(). */
  const std::vector<std::vector<std::size_t>>&
  groups() const
  {
    return map_.groups;
  }

  /** \brief Moves all scans onto each other and tells of all that the map is made of; once,
   * after group(). Fills in no timings. */
  MultiviewResult
  finish();

private:
  bool
  reconsider(const std::vector<double>& confidences);

  double min_confidence_;
  ThreadPool& pool_;
  MapScans scans_;
  std::vector<ScanRelation> relations_;
  /** \brief That group() has not seen. */
  bool has_news_ = false;
  std::vector<PairVotes> pairs_;
  Grouping map_;
};

} // namespace pcl_flashreg
