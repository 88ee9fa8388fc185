// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "map_run.h"

#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief Whether all scans are in one map. */
bool
isComplete(const MapRun& run);

/** \brief The outcome for a person, several lines: the verdict in the first. */
std::string
formatReport(const MapRun& run);

/** \brief The outcome on a page, see formatPage().
 * \param[in] options as they were typed */
std::string
formatPageOf(const MapRun& run, const std::vector<std::string>& options);

/** \brief Times differ from run to run; all else is the same to the last byte. */
enum class WithTimes { No, Yes };

/** \brief The outcome for a program, one JSON object. Keys are only ever added. Scans are
 * numbered from 0, groups from 1, the largest first; a scan that is in none with others has
 * neither a group nor a pose. Angles are in radians. */
std::string
formatJson(const MapRun& run, WithTimes times);

} // namespace pcl_flashreg::map
