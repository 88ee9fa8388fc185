// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "multiview/likeness.h"

namespace pcl_flashreg {

using ScanPairs = std::vector<MultiviewRegistration::ScanPair>;

/** \brief Each scan with those that are most like it and, of a sequence, with the next few. */
ScanPairs
firstPairs(const Likeness& likeness,
           std::size_t count,
           const MultiviewOptions& options);

/** \brief Of scans that the map does not tie to each other, pairs that have not been tried; once
 * there are none, those that promised something, the other way round. */
ScanPairs
untiedPairs(const Likeness& likeness,
            const std::vector<ScanRelation>& tried,
            const MultiviewResult& map,
            const MultiviewOptions& options);

} // namespace pcl_flashreg
