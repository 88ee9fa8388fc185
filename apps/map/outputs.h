// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../program/messages.h"
#include "map_run.h"
#include "options.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief Where what belongs to one map goes: the largest (0) to the path itself, others to
 * "map_2.pcd", "map_3.pcd" beside "map.pcd". */
std::string
pathOfMap(const std::string& path, std::size_t map);

/** \brief See program::checkOutputPaths(); and the merged cloud must not lie in a folder of
 * scans, where it would be one of them the next time.
 * \throws UsageError if that is not so */
void
checkOutputs(const Options& options, const std::vector<ScanFile>& files);

/** \brief Writes clouds, poses, the graph and the picture; not the page and the JSON, which
 * tell how long that took.
 * \return the merged clouds
 * \throws io::InputError if a file can't be read again, or not be written */
std::vector<WrittenCloud>
writeOutputs(const Options& options,
             const MapRun& run,
             const MultiviewRegistration::ScanSource& source,
             const program::Messages& messages);

} // namespace pcl_flashreg::map
