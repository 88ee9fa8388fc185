// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "number_table.h"

#include "error.h"
#include "text.h"

#include <string>

namespace pcl_flashreg::io {
namespace {

std::string
atLine(std::size_t line)
{
  return "line " + std::to_string(line) + ": ";
}

} // namespace

NumberTable
parseNumberTable(std::string_view text)
{
  NumberTable table;
  LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    line = line.substr(0, line.find('#'));
    std::size_t columns = 0;
    for (auto word = takeWord(line, true); !word.empty(); word = takeWord(line, true)) {
      double value = 0;
      if (!parseDouble(word, value))
        throw InputError(atLine(lines.lineNumber()) + "'" +
                         std::string(word.substr(0, 40)) + "' is not a number");
      table.values.push_back(value);
      ++columns;
    }
    if (columns == 0)
      continue;
    if (table.columns == 0)
      table.columns = columns;
    if (columns != table.columns)
      throw InputError(
          atLine(lines.lineNumber()) + "expected " + std::to_string(table.columns) +
          " numbers, as in the first row, " + "found " + std::to_string(columns));
    table.lines.push_back(lines.lineNumber());
  }
  if (table.rows() == 0)
    throw InputError("holds no rows of numbers");
  return table;
}

} // namespace pcl_flashreg::io
