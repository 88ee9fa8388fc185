// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

/** \brief Rows of numbers as a text holds them; all rows have the same length. */
struct NumberTable {
  std::size_t columns = 0;
  /** \brief rows() x columns, row by row. */
  std::vector<double> values;
  /** \brief Where each row stood in the text, from 1. */
  std::vector<std::size_t> lines;

  std::size_t
  rows() const
  {
    return lines.size();
  }

  const double*
  row(std::size_t i) const
  {
    return values.data() + i * columns;
  }
};

/** \brief "line 7: ", for messages. */
std::string
atLine(std::size_t line);

/** \brief Reads rows of numbers, separated by blanks or commas. Empty lines, and what
 * follows a '#', are left out. "nan" and "inf" are numbers. Decimal commas are refused:
 * in "1,5 2,5" a comma cannot separate, since blanks do.
 * \throws InputError with the number of the line, if a word is no number or a row has
 * another length than the first; and if there is no row
 */
NumberTable
parseNumberTable(std::string_view text);

} // namespace pcl_flashreg::io
