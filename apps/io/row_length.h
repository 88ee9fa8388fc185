// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief The rows of a cloud without a header that can be told from its values. */
constexpr std::size_t kShortestRow = 3, kLongestRow = 16;

/** \brief How many float32 values a row of a table has, told from the values alone.
 *
 * The columns of a cloud hold different things (a height is no intensity, and no x):
 * cut into rows of the right length, the table tells by its column what values to
 * expect, and cut into others, where every column holds a bit of each, it tells little.
 * The order of the rows doesn't matter.
 * \param[in] bytes the table's, row after row; what is left of a last row doesn't count
 * \return kShortestRow to kLongestRow; 0 if no length stands out
 */
std::size_t
rowLengthOf(std::string_view bytes);

} // namespace pcl_flashreg::io
