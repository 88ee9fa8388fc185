// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan_colors.h"

#include <algorithm>
#include <array>
#include <tuple>

namespace pcl_flashreg::map {
namespace {

using drawing::Color;

/** \brief Okabe and Ito's, but for black and yellow, then the same in dark. */
constexpr std::array<Color, 12> PALETTE = {{{0, 114, 178},
                                            {213, 94, 0},
                                            {0, 158, 115},
                                            {204, 121, 167},
                                            {230, 159, 0},
                                            {86, 180, 233},
                                            {0, 62, 98},
                                            {122, 48, 0},
                                            {0, 84, 60},
                                            {120, 52, 92},
                                            {134, 90, 0},
                                            {36, 100, 138}}};
constexpr std::size_t LIGHT = 6;

} // namespace

std::vector<Color>
scanColors(const MultiviewResult& result)
{
  const std::size_t count = result.scans.size();
  std::vector<std::vector<std::size_t>> tied(count);
  for (const MapEdge& edge : result.edges)
    if (edge.fate == EdgeFate::Used) {
      tied[edge.source].push_back(edge.target);
      tied[edge.target].push_back(edge.source);
    }
  std::vector<std::size_t> chosen(count, PALETTE.size());
  for (const std::vector<std::size_t>& group : result.groups) {
    const std::size_t colors = group.size() > LIGHT ? PALETTE.size() : LIGHT;
    std::array<std::size_t, PALETTE.size()> used{};
    for (const std::size_t scan : group) {
      std::array<std::size_t, PALETTE.size()> beside{};
      for (const std::size_t other : tied[scan])
        if (chosen[other] < PALETTE.size())
          ++beside[chosen[other]];
      std::size_t best = 0;
      for (std::size_t c = 1; c < colors; ++c)
        if (std::tie(beside[c], used[c]) < std::tie(beside[best], used[best]))
          best = c;
      chosen[scan] = best;
      ++used[best];
    }
  }
  std::vector<Color> result_colors;
  for (const std::size_t c : chosen)
    result_colors.push_back(PALETTE[std::min(c, PALETTE.size() - 1)]);
  return result_colors;
}

} // namespace pcl_flashreg::map
