// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../results/results_file.h"

#include <cstddef>
#include <string>

namespace pcl_flashreg::evaluate {

/** \brief The kind of the parts, as batch::partPath() takes it: rows of a rank that the
 * first one has not merged yet. */
constexpr const char* RANK = "rank";

/** \brief What is there of a run already: its file, and the parts of a run over ranks that
 * was killed, however many they were.
 * \throws io::InputError if a file is malformed or was made with another configuration
 */
Results
readWithParts(const std::string& csv, const Config& config);

/** \brief Removes the parts. */
void
removeParts(const std::string& csv);

/** \brief One result from those of all shards.
 * \throws io::InputError if the shards' settings differ, if a pair is in two of them, or
 * if one is in none
 */
Results
mergeShards(const std::vector<std::string>& files);

} // namespace pcl_flashreg::evaluate
