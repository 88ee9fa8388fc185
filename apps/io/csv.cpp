// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "csv.h"

#include <array>
#include <charconv>

namespace pcl_flashreg::io {

std::string
joinCsv(const std::vector<std::string>& cells)
{
  std::string line;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front())
      line += ',';
    if (cell.find_first_of(",\"") == std::string::npos) {
      line += cell;
      continue;
    }
    line += '"';
    for (const char c : cell)
      line += c == '"' ? std::string("\"\"") : std::string(1, c);
    line += '"';
  }
  return line;
}

std::vector<std::string>
splitCsv(std::string_view line)
{
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool is_quote = line[i] == '"';
    if (quoted && is_quote && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (is_quote)
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  }
  return cells;
}

std::string
toText(double value)
{
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end.ptr};
}

} // namespace pcl_flashreg::io
