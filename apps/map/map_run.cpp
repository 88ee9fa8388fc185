// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map_run.h"

#include <algorithm>

namespace pcl_flashreg::map {

std::vector<std::string>
namesOf(const MapRun& run)
{
  std::vector<std::string> names;
  for (const ScanFile& scan : run.scans)
    names.push_back(scan.name);
  return names;
}

std::size_t
numberOfMaps(const MultiviewResult& result)
{
  return static_cast<std::size_t>(
      std::count_if(result.groups.begin(), result.groups.end(), [](const auto& group) {
        return group.size() > 1;
      }));
}

bool
isPlaced(const MultiviewResult& result, std::size_t scan)
{
  return result.groups[result.scans[scan].group].size() > 1;
}

} // namespace pcl_flashreg::map
