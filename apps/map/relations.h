// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../batch/config.h"
#include "../batch/ranks.h"
#include "options.h"
#include "scan_reader.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief The file that --pairs, or a part of several, goes to is not there yet, unless the
 * run goes on with it.
 * \throws UsageError if that is not so
 */
void
checkPairsFile(const Options& options);

/** \brief The resolution of the run that is gone on with; nothing if there is none.
 * \throws io::InputError if its file is malformed */
std::optional<double>
resolutionOfPairs(const Options& options);

/** \brief What pairs of scans say: what the files of earlier runs know is taken from there,
 * the others are registered, by all ranks together, and go to files as they come. */
class PairRelations {
public:
  using ScanPair = MultiviewRegistration::ScanPair;

  /** \brief All arguments are kept. With --resume or --add reads what there is.
   * \throws io::InputError as knownRelations() */
  PairRelations(const Options& options,
                const ScanSet& scans,
                const MultiviewRegistration::ScanSource& source,
                const batch::Ranks& ranks,
                MultiviewRegistration& registration);

  /** \brief Of these pairs, in their order; the same on all ranks, which all have to call it.
   * \throws io::InputError if a file can't be written */
  std::vector<ScanRelation>
  of(const std::vector<ScanPair>& pairs);

  /** \brief With --shard: its part of the pairs, of those that no earlier run has put into
   * --pairs.
   * \return whether there were any */
  bool
  relateShard(const std::vector<ScanPair>& pairs);

  /** \brief Puts the file into its order. */
  void
  finish() const;

  /** \brief How many of the pairs that of() was asked for were known before. */
  std::size_t
  knownBefore() const
  {
    return known_before_;
  }

private:
  using Known = std::map<ScanPair, ScanRelation>;

  static std::vector<ScanPair>
  missing(const Known& known, const std::vector<ScanPair>& pairs);
  void
  readInto(const std::string& path, Known& known) const;
  void
  write(const std::string& path, const Known& known) const;
  void
  putTogether();
  void
  relateTo(const std::string& path, const std::vector<ScanPair>& pairs, Known& known);
  void
  relateWithRanks(const std::vector<ScanPair>& pairs);

  const Options& options_;
  const MultiviewRegistration::ScanSource& source_;
  const batch::Ranks& ranks_;
  MultiviewRegistration& registration_;
  batch::Config config_;
  Known known_;
  std::size_t known_before_ = 0;
};

} // namespace pcl_flashreg::map
