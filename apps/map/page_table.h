// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief A table in Markdown whose columns are aligned.
 * \param[in] sides a letter a column: 'l' for words, 'r' for numbers
 * \param[in] rows of as many cells; the first one is the heading */
std::string
formatTable(const std::string& sides, std::vector<std::vector<std::string>> rows);

} // namespace pcl_flashreg::map
