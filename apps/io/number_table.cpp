// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "number_table.h"

#include "error.h"
#include "text.h"

#include <algorithm>
#include <string>

namespace pcl_flashreg::io {
namespace {

bool
isDigits(std::string_view text)
{
  return !text.empty() &&
         text.find_first_not_of("0123456789") == std::string_view::npos;
}

/** \brief Whether a word is "1,5", "-12,25" or "1,5e-3". */
bool
hasDecimalComma(std::string_view word)
{
  if (!word.empty() && (word[0] == '+' || word[0] == '-'))
    word.remove_prefix(1);
  const std::size_t comma = word.find(',');
  if (comma == std::string_view::npos)
    return false;
  const std::string_view behind = word.substr(comma + 1);
  return isDigits(word.substr(0, comma)) &&
         isDigits(behind.substr(0, behind.find_first_of("eE"))) &&
         behind.find(',') == std::string_view::npos;
}

/** \brief A comma cannot separate where blanks or semicolons do.
 * \throws InputError if a line has several words, and one of them a decimal comma
 */
void
refuseDecimalCommas(std::string_view line, std::size_t number)
{
  if (line.find(',') == std::string_view::npos)
    return;
  constexpr std::string_view separators = " \t\r\v\f;";
  std::string_view found;
  std::size_t words = 0;
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(separators), line.size()));
    if (line.empty())
      break;
    std::string_view word = line.substr(0, line.find_first_of(separators));
    line.remove_prefix(word.size());
    ++words;
    if (word.back() == ',')
      word.remove_suffix(1);
    if (found.empty() && hasDecimalComma(word))
      found = word;
  }
  if (words > 1 && !found.empty())
    throw InputError(atLine(number) + "'" + std::string(found.substr(0, 40)) +
                     "' has a decimal comma: write decimal points (a comma that "
                     "separates has a blank beside it, or there are no blanks)");
}

} // namespace

std::string
atLine(std::size_t line)
{
  return "line " + std::to_string(line) + ": ";
}

NumberTable
parseNumberTable(std::string_view text)
{
  NumberTable table;
  LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    line = line.substr(0, line.find('#'));
    refuseDecimalCommas(line, lines.lineNumber());
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
