// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pair_list.h"

#include "../../io/error.h"
#include "../../io/file.h"
#include "../../io/text.h"
#include "../../io/transform_io.h"

#include <filesystem>
#include <limits>

namespace pcl_flashreg::evaluate {
namespace {

constexpr std::size_t TEXT_COLUMNS = 6;

std::vector<std::string>
splitTabs(std::string_view line)
{
  std::vector<std::string> cells;
  for (std::size_t tab = 0; tab != std::string_view::npos;) {
    tab = line.find('\t');
    cells.emplace_back(line.substr(0, tab));
    line.remove_prefix(tab == std::string_view::npos ? line.size() : tab + 1);
  }
  return cells;
}

Pair
parsePair(const std::vector<std::string>& cells)
{
  const bool no_pose = cells.size() == TEXT_COLUMNS + 1 && cells.back() == "none";
  if (cells.size() != TEXT_COLUMNS + 16 && !no_pose)
    throw io::InputError("found " + std::to_string(cells.size()) +
                         " columns, expected 22: dataset, split, source, target, "
                         "correspondences, note and 16 numbers (or one 'none')");
  std::string matrix;
  for (std::size_t i = TEXT_COLUMNS; i < cells.size(); ++i)
    matrix += cells[i] + ' ';
  Pair pair;
  pair.dataset = cells[0];
  pair.scene = std::filesystem::path(cells[2]).parent_path().filename().string();
  pair.source = cells[2];
  pair.target = cells[3];
  pair.correspondences = cells[4];
  if (no_pose)
    pair.T_target_source.translation.setConstant(
        std::numeric_limits<double>::quiet_NaN());
  else
    pair.T_target_source = io::parseTransform(matrix);
  return pair;
}

} // namespace

std::vector<Pair>
readPairList(const std::string& path)
{
  const std::string text = io::readFile(path);
  std::vector<Pair> pairs;
  io::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    if (line.empty() || line[0] == '#')
      continue;
    try {
      pairs.push_back(parsePair(splitTabs(line)));
    }
    catch (const io::InputError& error) {
      throw io::InputError(path + ": line " + std::to_string(lines.lineNumber()) +
                           ": " + error.what());
    }
  }
  return pairs;
}

} // namespace pcl_flashreg::evaluate
