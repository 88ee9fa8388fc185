// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../io/csv.h"
#include "../io/error.h"
#include "../io/text.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::batch {

// Rows of comma-separated values that a program appends as it goes: it may be killed at any
// time.

using Cells = std::vector<std::string>;

/** \brief Without what follows the last end of a line: a killed run may leave such. */
inline std::string_view
wholeLines(std::string_view bytes)
{
  const std::size_t end = bytes.rfind('\n');
  return end == std::string_view::npos ? std::string_view() : bytes.substr(0, end + 1);
}

/** \brief Calls take(cells) for every row below the header with the names of the columns.
 * \throws io::InputError with the line, what take() throws included */
template <typename Take>
void
readRows(io::LineReader& lines, const Cells& columns, Take&& take)
{
  std::string_view line;
  if (!lines.next(line) || io::splitCsv(line) != columns)
    throw io::errorAtLine(lines.lineNumber(),
                          "expected the columns " + io::joinCsv(columns));
  while (lines.next(line))
    try {
      take(io::splitCsv(line));
    }
    catch (const io::InputError& error) {
      throw io::errorAtLine(lines.lineNumber(), error.what());
    }
}

/** \brief Takes the cells of a row one after the other. */
class CellReader {
public:
  /** \throws io::InputError if there are more or fewer cells than columns */
  CellReader(const Cells& cells, const Cells& columns)
      : cells_(cells), columns_(columns)
  {
    if (cells.size() != columns.size())
      throw io::InputError("found " + std::to_string(cells.size()) +
                           " columns, expected " + std::to_string(columns.size()));
  }

  const std::string&
  text()
  {
    return cells_[next_++];
  }

  /** \throws io::InputError with the name of the column; so do the next ones */
  std::size_t
  count()
  {
    std::size_t value = 0;
    if (!io::parseUnsigned(cells_[next_], value))
      fail("a count");
    ++next_;
    return value;
  }

  bool
  flag()
  {
    const std::size_t value = count();
    if (value > 1) {
      --next_;
      fail("0 or 1");
    }
    return value == 1;
  }

  double
  number()
  {
    double value = 0;
    if (!io::parseDouble(cells_[next_], value))
      fail("a number");
    ++next_;
    return value;
  }

private:
  [[noreturn]] void
  fail(const std::string& expected) const
  {
    throw io::InputError("column " + columns_[next_] + ": '" + cells_[next_] +
                         "' is not " + expected);
  }

  const Cells& cells_;
  const Cells& columns_;
  std::size_t next_ = 0;
};

} // namespace pcl_flashreg::batch
