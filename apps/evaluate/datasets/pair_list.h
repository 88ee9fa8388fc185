// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "pair.h"

#include <string>
#include <vector>

namespace pcl_flashreg::evaluate {

/** \brief Reads a list of pairs: a tab-separated file with the columns dataset, split,
 * source, target, correspondences, note, and the 16 numbers of T_target_source, row-major,
 * or "none" for clouds that do not overlap; lines that begin with # are left out. The folder of the source is the scene.
 * \throws io::InputError with the number of the line
 */
std::vector<Pair>
readPairList(const std::string& path);

} // namespace pcl_flashreg::evaluate
