// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "map_run.h"

#include <cstddef>
#include <string>

namespace pcl_flashreg::map {

/** \brief Scans of a group, a row each: number, translation, quaternion (x y z w). The number
 * is the name of the scan without its extension where all names are numbers (times), else
 * its place in the order of all scans, from 0; comments say which scan that is. */
std::string
formatTum(const MapRun& run, std::size_t group);

/** \brief Scans of a group, a row each: the upper three rows of the 4 x 4 matrix. */
std::string
formatKitti(const MapRun& run, std::size_t group);

/** \brief All scans, a row each. Groups are numbered from 1; a scan that is in none has
 * empty cells for its group and its pose. */
std::string
formatCsv(const MapRun& run);

} // namespace pcl_flashreg::map
