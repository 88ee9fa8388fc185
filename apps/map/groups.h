// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/multiview_registration.h>

#include <algorithm>
#include <cstddef>

namespace pcl_flashreg::map {

/** \brief Groups of more than one scan: they come first. */
inline std::size_t
numberOfMaps(const MultiviewResult& result)
{
  return static_cast<std::size_t>(
      std::count_if(result.groups.begin(), result.groups.end(), [](const auto& group) {
        return group.size() > 1;
      }));
}

/** \brief Whether the scan belongs to a group with others. */
inline bool
isPlaced(const MultiviewResult& result, std::size_t scan)
{
  return result.groups[result.scans[scan].group].size() > 1;
}

} // namespace pcl_flashreg::map
