// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief Names without what all of them begin and end with, but for whole numbers:
 * "12" of "scans/cloud_12.ply", beside "scans/cloud_13.ply". As they are, if nothing would
 * be left of one. */
std::vector<std::string>
shortNames(const std::vector<std::string>& names);

} // namespace pcl_flashreg::map
