// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "poses.h"

#include "../io/csv.h"
#include "../io/pose_io.h"

namespace pcl_flashreg::map {
namespace {

std::vector<io::PosedScan>
posedScans(const MapRun& run, std::size_t group)
{
  std::vector<std::string> paths;
  for (const ScanFile& scan : run.scans)
    paths.push_back(scan.path);
  const std::vector<std::string> numbers = io::numbersOf(paths);
  std::vector<io::PosedScan> posed;
  for (const std::size_t scan : run.result.groups[group])
    posed.push_back(
        {numbers[scan], run.scans[scan].name, run.result.scans[scan].T_group_scan});
  return posed;
}

} // namespace

std::string
formatTum(const MapRun& run, std::size_t group)
{
  return io::formatTum(posedScans(run, group));
}

std::string
formatKitti(const MapRun& run, std::size_t group)
{
  return io::formatKitti(posedScans(run, group));
}

std::string
formatCsv(const MapRun& run)
{
  std::vector<std::string> columns{"name", "group", "confidence", "edges"};
  columns.insert(columns.end(), {"tx", "ty", "tz", "qx", "qy", "qz", "qw"});
  std::string text = io::joinCsv(columns) + '\n';
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const ScanPlace& place = run.result.scans[i];
    const bool placed = isPlaced(run.result, i);
    std::vector<std::string> cells{io::inOneLine(run.scans[i].name),
                                   placed ? std::to_string(place.group + 1) : "",
                                   io::numberText(place.confidence),
                                   std::to_string(place.edges)};
    if (placed)
      for (const std::string& cell : io::poseCells(place.T_group_scan))
        cells.push_back(cell);
    cells.resize(columns.size());
    text += io::joinCsv(cells) + '\n';
  }
  return text;
}

} // namespace pcl_flashreg::map
