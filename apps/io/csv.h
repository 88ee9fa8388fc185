// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

/** \brief A line of comma-separated values without its end; what holds a comma or a quote
 * is quoted. */
std::string
joinCsv(const std::vector<std::string>& cells);

/** \brief The reverse. */
std::vector<std::string>
splitCsv(std::string_view line);

/** \brief The fewest digits that make the same double again. */
std::string
toText(double value);

} // namespace pcl_flashreg::io
