// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pairs.h"

#include "../io/error.h"
#include "../io/file.h"
#include "../io/transform_io.h"

#include <sstream>

namespace pcl_flashreg::evaluate {
namespace {

constexpr std::size_t TEXT_COLUMNS = 6;

std::vector<std::string>
splitTabs(const std::string& line)
{
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, '\t');)
    cells.push_back(cell);
  return cells;
}

Pair
parsePair(const std::vector<std::string>& cells)
{
  if (cells.size() != TEXT_COLUMNS + 16)
    throw io::InputError("has " + std::to_string(cells.size()) +
                         " columns; expected 22: dataset, split, source, target, "
                         "correspondences, note and 16 numbers");
  std::string matrix;
  for (std::size_t i = TEXT_COLUMNS; i < cells.size(); ++i)
    matrix += cells[i] + ' ';
  return {cells[0], cells[2], cells[3], cells[4], io::parseTransform(matrix)};
}

} // namespace

std::vector<Pair>
readPairs(const std::string& path)
{
  std::istringstream text(io::readFile(path));
  std::vector<Pair> pairs;
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.empty() || line[0] == '#')
      continue;
    try {
      pairs.push_back(parsePair(splitTabs(line)));
    }
    catch (const io::InputError& error) {
      throw io::InputError(path + ": line " + std::to_string(number) + " " +
                           error.what());
    }
  }
  return pairs;
}

} // namespace pcl_flashreg::evaluate
