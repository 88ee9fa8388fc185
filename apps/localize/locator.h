// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "located.h"
#include "options.h"

namespace pcl_flashreg::localize {

/** \brief That a pose is away from the place of --near, for people. */
std::string
beyondNear(double distance, const Near& near, bool would_be_trusted);

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

  /** \brief The same of a scan of a sequence, which is wanted afterwards, and tells of all
   * places where it may be.
   * \param[in] T_sequence_scan the guess is of the sequence
   * \param[out] scan empty if the file can't be used */
  Located
  locate(const program::ScanFile& file,
         const RigidTransform& T_sequence_scan,
         Scan& scan);

  const ScanIndex&
  map() const
  {
    return map_;
  }

private:
  Located
  locate(const program::ScanFile& file, const PairOptions& pair_options, Scan& scan);
  void
  place(const Scan& scan, const PairOptions& pair_options, Located& located);
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
