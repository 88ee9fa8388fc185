// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "located.h"
#include "options.h"

namespace pcl_flashreg::localize {

/** \brief Finds scans in a map, one after the other. */
class Locator {
public:
  /** \param[in] options kept by reference, as `registration` is
   * \param[in] guess tried for every scan, if there is one */
  Locator(const Options& options,
          const std::optional<RigidTransform>& guess,
          const ScanIndex& map,
          PairRegistration& registration);

  /** \brief A file that can't be used is no exception, but an error in what is
   * returned.
   * \throws BackendError, std::bad_alloc if the machine fails */
  Located
  locate(const program::ScanFile& file);

private:
  void
  place(const Scan& scan, Located& located);
  const ScanIndex&
  partFor(const Scan& scan);
  void
  judgeNear(Located& located) const;

  const Options& options_;
  PairOptions pair_options_;
  ScanIndex map_;
  PairRegistration& registration_;
  /** \brief With --near: what of the map is looked at, and its radius. */
  ScanIndex part_;
  double part_radius_ = 0;
};

} // namespace pcl_flashreg::localize
