// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../batch/ranks.h"
#include "scan_reader.h"

#include <pcl_flashreg/multiview_registration.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl_flashreg::map {

/** \brief The file that --pairs, or a part of several, goes to is not there yet, unless the
 * run goes on with it.
 * \throws UsageError if that is not so */
void
checkPairsFile(const Options& options);

/** \brief The resolution of the run that is gone on with; nothing if there is none.
 * \throws io::InputError if its file is malformed */
std::optional<double>
resolutionOfPairs(const Options& options);

/** \brief What the pairs of a run say. */
struct Relations {
  /** \brief Of all pairs that are worth a try, by target and source; with --shard of the
   * shard's alone. On ranks but the first, none. */
  std::vector<ScanRelation> all;
  /** \brief Those that earlier runs knew. */
  std::size_t known = 0;
};

/** \brief Registers the pairs of scans; those that --pairs knows are taken from there.
 * \throws io::InputError as knownRelations(), or if a file can't be written */
Relations
relateScans(const Options& options,
            const ScanSet& scans,
            const MultiviewRegistration::ScanSource& source,
            const batch::Ranks& ranks,
            MultiviewRegistration& registration);

} // namespace pcl_flashreg::map
