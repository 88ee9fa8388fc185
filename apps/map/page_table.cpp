// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "page_table.h"

#include <algorithm>

namespace pcl_flashreg::map {
namespace {

/** \brief Of what is drawn: bytes that continue a character of UTF-8 do not count. */
std::size_t
widthOf(const std::string& word)
{
  return static_cast<std::size_t>(std::count_if(
      word.begin(), word.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

/** \brief With what would end the cell, or the line, taken out. */
std::string
cellOf(const std::string& word)
{
  std::string cell;
  for (const char c : word)
    if (c == '|')
      cell += "\\|";
    else
      cell += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  return cell;
}

} // namespace

std::string
formatTable(const std::string& sides, std::vector<std::vector<std::string>> rows)
{
  std::vector<std::size_t> widths(sides.size(), 3);
  for (std::vector<std::string>& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      row[c] = cellOf(row[c]);
      widths[c] = std::max(widths[c], widthOf(row[c]));
    }
  std::string text;
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - widthOf(row[c]), ' ');
      text += "| " + (sides[c] == 'l' ? row[c] + padding : padding + row[c]) + ' ';
    }
    text += "|\n";
    if (&row != &rows.front())
      continue;
    for (std::size_t c = 0; c < row.size(); ++c)
      text += sides[c] == 'l' ? "|:" + std::string(widths[c] + 1, '-')
                              : "|" + std::string(widths[c] + 1, '-') + ":";
    text += "|\n";
  }
  return text;
}

} // namespace pcl_flashreg::map
