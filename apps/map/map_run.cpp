// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "map_run.h"

namespace pcl_flashreg::map {

std::vector<std::string>
namesOf(const MapRun& run)
{
  std::vector<std::string> names;
  for (const ScanFile& scan : run.scans)
    names.push_back(scan.name);
  return names;
}

} // namespace pcl_flashreg::map
