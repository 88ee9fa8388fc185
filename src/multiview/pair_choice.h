// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/likeness.h"

namespace pcl_flashreg {

/** \brief Which pairs of scans are tried. */
class PairChoice {
public:
  using ScanPairs = std::vector<MultiviewRegistration::ScanPair>;
  using Groups = std::vector<std::vector<std::size_t>>;

  /** \brief Asks for every scan twice. */
  PairChoice(std::size_t count,
             const MultiviewRegistration::ScanSource& scans,
             const MultiviewOptions& options,
             ThreadPool& pool);

  /** \brief Each scan with those that are most like it and, of a sequence, with the next few. */
  ScanPairs
  first() const;

  /** \brief For the next round, of scans that the map does not tie to each other: pairs that
   * have not been tried; once there are none, or there will be no more rounds, those that
   * promised something, the other way round.
   * \param[in] tried all so far
   * \param[in] groups of the map that they make */
  ScanPairs
  next(const std::vector<ScanRelation>& tried, const Groups& groups);

private:
  std::size_t count_;
  const MultiviewOptions& options_;
  int rounds_ = 0;
  Likeness likeness_;
};

} // namespace pcl_flashreg
