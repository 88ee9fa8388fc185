// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "page.h"

#include "../program/rounded.h"
#include "groups.h"
#include "page_table.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <algorithm>

namespace pcl_flashreg::map {
namespace {

using program::rounded;

/** \brief Rows of a table that may be as long as there are scans. */
constexpr std::size_t MOST_ROWS = 20, WEAKEST = 5;

/** \brief A pair that is more likely right than not, by itself. */
constexpr double CERTAIN = 0.5;

constexpr double DEGREE = 3.14159265358979323846 / 180;

std::size_t
countOf(const MultiviewResult& result, EdgeFate fate)
{
  return static_cast<std::size_t>(
      std::count_if(result.edges.begin(), result.edges.end(), [&](const MapEdge& edge) {
        return edge.fate == fate;
      }));
}

std::size_t
rejectedAndCertain(const MultiviewResult& result)
{
  return static_cast<std::size_t>(
      std::count_if(result.edges.begin(), result.edges.end(), [](const MapEdge& edge) {
        return edge.fate == EdgeFate::Disagrees && edge.pair_confidence >= CERTAIN;
      }));
}

/** \brief Used edges that no tree needs: each closes a loop. */
std::size_t
loopsOf(std::size_t edges, std::size_t scans, std::size_t groups)
{
  return edges + groups > scans ? edges + groups - scans : 0;
}

std::string
plural(std::size_t count, const std::string& word)
{
  return std::to_string(count) + ' ' + word + (count == 1 ? "" : "s");
}

std::string
pairName(const PageInput& input, const MapEdge& edge)
{
  return input.names[edge.source] + " to " + input.names[edge.target];
}

std::string
formatSummary(const PageInput& input)
{
  const MultiviewResult& result = input.result;
  const std::size_t used = countOf(result, EdgeFate::Used);
  const std::size_t maps = numberOfMaps(result);
  std::string options;
  for (const std::string& option : input.options)
    options += (options.empty() ? "" : " ") + option;
  std::string text =
      "# Map of " + plural(result.scans.size(), "scan") +
      "\n\n- placed: " + std::to_string(result.placed()) + " of " +
      plural(result.scans.size(), "scan") + ", in " + plural(maps, "map") +
      "\n- pairs: " + std::to_string(input.pairs) +
      " registered\n- edges: " + std::to_string(used) + " used, " +
      std::to_string(countOf(result, EdgeFate::Disagrees)) + " rejected (" +
      std::to_string(rejectedAndCertain(result)) + " of them certain by themselves), " +
      std::to_string(countOf(result, EdgeFate::Apart)) +
      " between scans that are not in one map\n- loops: " +
      std::to_string(loopsOf(used, result.placed(), maps)) +
      " independent ones\n- resolution: " + detail::toText(input.resolution) +
      "\n- options: " + (options.empty() ? "none" : '`' + options + '`') + '\n';
  if (input.times.empty())
    return text;
  text += "- time: ";
  for (const auto& [what, milliseconds] : input.times)
    text += (&what == &input.times.front().first ? "" : ", ") + what + ' ' +
            rounded(milliseconds / 1000, 1) + " s";
  return text + '\n';
}

/** \brief Where there are several. */
std::string
formatMaps(const PageInput& input)
{
  const MultiviewResult& result = input.result;
  const std::size_t maps = numberOfMaps(result);
  if (maps < 2)
    return "";
  std::vector<std::vector<std::string>> rows = {{"map", "scans", "edges", "loops"}};
  for (std::size_t g = 0; g < std::min(maps, MOST_ROWS); ++g) {
    const std::size_t scans = result.groups[g].size();
    const auto edges = static_cast<std::size_t>(std::count_if(
        result.edges.begin(), result.edges.end(), [&](const MapEdge& edge) {
          return edge.fate == EdgeFate::Used && result.scans[edge.source].group == g;
        }));
    rows.push_back({std::to_string(g + 1) + ": " + input.names[result.groups[g][0]] +
                        " and others",
                    std::to_string(scans),
                    std::to_string(edges),
                    std::to_string(loopsOf(edges, scans, 1))});
  }
  std::string text =
      "\n## Maps that nothing ties together\n\n" + formatTable("lrrr", rows);
  if (maps > MOST_ROWS)
    text += "\nand " + std::to_string(maps - MOST_ROWS) + " smaller ones\n";
  return text;
}

/** \brief Why a scan is by itself, as far as its pairs tell. */
std::string
reasonFor(const PageInput& input, std::size_t scan)
{
  const MapEdge* best = nullptr;
  for (const MapEdge& edge : input.result.edges)
    if ((edge.source == scan || edge.target == scan) &&
        (best == nullptr || edge.pair_confidence > best->pair_confidence))
      best = &edge;
  if (best == nullptr)
    return "no pair with another scan has a pose";
  const std::string other =
      input.names[best->source == scan ? best->target : best->source];
  const std::string confidence =
      " (confidence " + rounded(best->pair_confidence, 2) + ")";
  if (best->pair_confidence < CERTAIN)
    return "no pair is certain, the best is that with " + other + confidence;
  return "its pair with " + other + confidence + " does not fit what other scans say";
}

std::string
formatUnplaced(const PageInput& input)
{
  std::vector<std::vector<std::string>> rows = {{"scan", "why"}};
  std::size_t unplaced = 0;
  for (const std::vector<std::size_t>& group : input.result.groups)
    if (group.size() == 1 && ++unplaced <= MOST_ROWS)
      rows.push_back({input.names[group[0]], reasonFor(input, group[0])});
  if (unplaced == 0)
    return "";
  std::string text = "\n## Scans that are not placed\n\n" + formatTable("ll", rows);
  if (unplaced > MOST_ROWS)
    text += "\nand " + std::to_string(unplaced - MOST_ROWS) + " more\n";
  return text;
}

/** \brief A row: the median of the used edges, and the worst of them by its name. */
std::vector<std::string>
residualRow(const PageInput& input,
            const std::string& title,
            double MapEdge::*residual,
            double unit,
            int decimals)
{
  std::vector<const MapEdge*> edges;
  for (const MapEdge& edge : input.result.edges)
    if (edge.fate == EdgeFate::Used)
      edges.push_back(&edge);
  // The first of equal ones is the worst: it does not depend on the sorting.
  std::stable_sort(edges.begin(), edges.end(), [&](const MapEdge* a, const MapEdge* b) {
    return a->*residual > b->*residual;
  });
  return {title,
          rounded(edges[edges.size() / 2]->*residual / unit, decimals),
          rounded(edges[0]->*residual / unit, decimals),
          pairName(input, *edges[0])};
}

/** \brief How far edges and map are apart. */
std::string
formatResiduals(const PageInput& input)
{
  if (countOf(input.result, EdgeFate::Used) == 0)
    return "";
  // As many decimals as a hundredth of the resolution has.
  int decimals = 0;
  for (double step = 1; decimals < 9 && step > 0.02 * input.resolution; step /= 10)
    ++decimals;
  return "\n## Residuals of the used edges\n\n" +
         formatTable(
             "lrrl",
             {{"", "median", "worst", "which"},
              residualRow(
                  input, "rotation [deg]", &MapEdge::rotation_residual, DEGREE, 3),
              residualRow(
                  input, "translation", &MapEdge::translation_residual, 1, decimals)});
}

/** \brief The scans whose places are least certain. */
std::string
formatWeakest(const PageInput& input)
{
  const MultiviewResult& result = input.result;
  std::vector<std::size_t> scans;
  for (std::size_t i = 0; i < result.scans.size(); ++i)
    if (isPlaced(result, i))
      scans.push_back(i);
  if (scans.empty())
    return "";
  std::stable_sort(scans.begin(), scans.end(), [&](std::size_t a, std::size_t b) {
    return result.scans[a].confidence < result.scans[b].confidence;
  });
  scans.resize(std::min(scans.size(), WEAKEST));
  std::vector<std::vector<std::string>> rows = {{"scan", "confidence", "edges"}};
  for (const std::size_t i : scans)
    rows.push_back({input.names[i],
                    rounded(result.scans[i].confidence, 3),
                    std::to_string(result.scans[i].edges)});
  return "\n## Weakest ties\n\n" + formatTable("lrr", rows);
}

} // namespace

std::string
formatPage(const PageInput& input)
{
  return formatSummary(input) + formatMaps(input) + formatUnplaced(input) +
         formatResiduals(input) + formatWeakest(input);
}

} // namespace pcl_flashreg::map
