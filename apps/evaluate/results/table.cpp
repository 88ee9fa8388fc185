// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "report.h"

#include <cmath>
#include <cstdio>

namespace pcl_flashreg::evaluate {
namespace {

template <typename... Values>
std::string
print(const char* format, Values... values)
{
  char text[256];
  std::snprintf(text, sizeof(text), format, values...);
  return text;
}

std::string
percent(double share)
{
  return std::isnan(share) ? "     -" : print("%6.2f", 100 * share);
}

std::string
title(const GroupSummary& group)
{
  std::string name = group.dataset.empty() ? "all" : group.dataset;
  if (!group.scene.empty())
    name += " / " + group.scene;
  return name +
         print(": %zu pairs, correspondences %.0f, of which %.2f %% right (medians)\n",
               group.pairs,
               group.correspondences.median,
               100 * group.inlier_ratio.median);
}

std::string
row(const MethodSummary& m)
{
  return print("  %-22s", m.method.c_str()) + percent(m.recall) +
         print("  %5.2f (%5.2f)  %6.3f (%6.3f)  ",
               m.rotation_error.mean,
               m.rotation_error.median,
               m.translation_error.mean,
               m.translation_error.median) +
         percent(m.precision) + "  " + percent(m.verdict_recall) +
         print("  %9.2f (%9.2f)", m.estimation_ms.median, m.estimation_ms.p95) +
         print("  %+7.2f  %8.2f\n", 100 * m.recall_difference, m.time_ratio);
}

std::string
times(const MethodSummary& m)
{
  std::string text = print("  ms, %s: features %.1f (%.1f), matching %.2f (%.2f)",
                           m.method.c_str(),
                           m.features_ms.median,
                           m.features_ms.p95,
                           m.matching_ms.median,
                           m.matching_ms.p95);
  for (const StageSpread& stage : m.stages_ms)
    text += print(
        ", %s %.2f (%.2f)", stage.name.c_str(), stage.spread.median, stage.spread.p95);
  return text + '\n';
}

constexpr const char* HEADER =
    "                                 errors of the right ones       trusted poses\n"
    "                         recall  RE (median)    TE (median)        right  recall  "
    "     estimation (p95)    against the first\n"
    "  method                      %  degrees                               %       %  "
    "           ms (ms)       recall  time\n";

} // namespace

std::string
formatTable(const std::vector<GroupSummary>& groups)
{
  std::string text;
  for (const GroupSummary& group : groups) {
    text += title(group) + HEADER;
    for (const MethodSummary& method : group.methods)
      text += row(method);
    if (group.scene.empty())
      for (const MethodSummary& method : group.methods)
        if (!method.stages_ms.empty())
          text += times(method);
    text += '\n';
  }
  return text;
}

std::string
formatMaps(const std::vector<MapSummary>& maps)
{
  if (maps.empty())
    return "";
  std::string text =
      "maps                            scans  placed  groups   tried    used "
      "  wrong  unknown  seconds\n";
  for (const MapSummary& map : maps)
    text += "  " + map.name +
            std::string(map.name.size() < 28 ? 28 - map.name.size() : 1, ' ') +
            print("%7zu %7zu %7zu %7zu %7zu %7zu  %7zu  %7.1f\n",
                  map.scans,
                  map.placed,
                  map.groups,
                  map.tried,
                  map.used_edges,
                  map.wrong_edges,
                  map.unknown_edges,
                  map.seconds);
  return text;
}

} // namespace pcl_flashreg::evaluate
