// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "report.h"

#include "../program/rounded.h"
#include "page.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <algorithm>

namespace pcl_flashreg::map {
namespace {

constexpr std::size_t WIDTH = 88, MARGIN = 12;

std::string
seconds(double milliseconds)
{
  return program::rounded(milliseconds / 1000, 1);
}

/** \brief "title       item, item," in lines of bearable length. */
std::string
formatList(std::string title, const std::vector<std::string>& items)
{
  title.resize(std::max(MARGIN, title.size() + 1), ' ');
  std::string text, line = title;
  for (const std::string& item : items) {
    const std::string word = item + (&item == &items.back() ? "" : ",");
    if (line.size() > MARGIN && line.size() + 1 + word.size() > WIDTH) {
      text += line + '\n';
      line = std::string(MARGIN, ' ');
    }
    line += (line.back() == ' ' ? "" : " ") + word;
  }
  return text + line + '\n';
}

std::vector<std::string>
namesOf(const MapRun& run, const std::vector<std::size_t>& scans)
{
  std::vector<std::string> names;
  for (const std::size_t scan : scans)
    names.push_back(run.scans[scan].name);
  return names;
}

std::string
formatVerdict(const MapRun& run)
{
  const std::size_t placed = run.result.placed(), maps = numberOfMaps(run.result);
  const std::string all = std::to_string(run.scans.size()) + " scans";
  if (placed == 0)
    return "no map: nothing ties any two of " + all + " together";
  const std::string in =
      maps == 1 ? "in one map"
                : "in " + std::to_string(maps) + " maps that nothing ties together";
  if (placed == run.scans.size())
    return "all " + all + " are placed, " + in;
  return std::to_string(placed) + " of " + all + " are placed, " + in;
}

/** \brief Who is where, unless all are in one map. */
std::string
formatGroups(const MapRun& run)
{
  std::string text;
  const std::size_t maps = numberOfMaps(run.result);
  for (std::size_t map = 0; map < maps && maps > 1; ++map)
    text += formatList("map " + std::to_string(map + 1),
                       namesOf(run, run.result.groups[map]));
  std::vector<std::string> apart;
  for (std::size_t i = 0; i < run.scans.size(); ++i)
    if (!isPlaced(run.result, i))
      apart.push_back(run.scans[i].name);
  if (!apart.empty())
    text += formatList("not placed", apart);
  return text;
}

std::string
formatLeftOut(const MapRun& run)
{
  std::string text;
  for (const LeftOutFile& file : run.left_out)
    text += formatList("left out", {file.path + ": " + file.reason});
  return text;
}

std::string
formatPairs(const MapRun& run)
{
  std::vector<std::string> items{std::to_string(run.pairs) + " registered"};
  if (run.known_pairs > 0)
    items.push_back(std::to_string(run.known_pairs) + " of them by earlier runs");
  return formatList("pairs", items);
}

/** \brief More than pairs were registered: all whose surfaces touch in the map. */
std::string
formatEdges(const MapRun& run)
{
  std::size_t used = 0, disagree = 0, apart = 0;
  for (const MapEdge& edge : run.result.edges) {
    used += edge.fate == EdgeFate::Used ? 1 : 0;
    disagree += edge.fate == EdgeFate::Disagrees ? 1 : 0;
    apart += edge.fate == EdgeFate::Apart ? 1 : 0;
  }
  std::vector<std::string> items{std::to_string(used) + " used"};
  if (disagree > 0)
    items.push_back(std::to_string(disagree) + " that the map contradicts");
  if (apart > 0)
    items.push_back(std::to_string(apart) + " too doubtful to tie scans together");
  return formatList("edges", items);
}

std::string
formatClouds(const MapRun& run)
{
  std::vector<std::string> items;
  for (const WrittenCloud& cloud : run.clouds)
    items.push_back(cloud.path + " (" + std::to_string(cloud.points) + " points)");
  return items.empty() ? "" : formatList("written", items);
}

std::string
formatTimes(const MapRun& run)
{
  const MapTimes& times = run.times;
  return formatList("time",
                    {seconds(times.total) + " s: reading " + seconds(times.reading),
                     "pairs " + seconds(times.relations),
                     "placing " + seconds(times.placing),
                     "writing " + seconds(times.writing)});
}

} // namespace

bool
isComplete(const MapRun& run)
{
  return run.result.groups.size() == 1;
}

std::string
formatReport(const MapRun& run)
{
  return formatVerdict(run) + '\n' + formatGroups(run) + formatLeftOut(run) +
         formatPairs(run) + formatEdges(run) +
         formatList(
             "resolution",
             {detail::toText(run.resolution) +
              (run.resolution_estimated ? " (estimated; --leaf sets another)" : "")}) +
         formatClouds(run) + formatTimes(run);
}

std::string
formatPageOf(const MapRun& run, const std::vector<std::string>& options)
{
  const std::vector<std::string> names = namesOf(run);
  const MapTimes& times = run.times;
  return formatPage({names,
                     run.result,
                     run.pairs,
                     run.resolution,
                     options,
                     {{"reading", times.reading},
                      {"pairs", times.relations},
                      {"placing", times.placing},
                      {"writing", times.writing},
                      {"total", times.total}}});
}

} // namespace pcl_flashreg::map
