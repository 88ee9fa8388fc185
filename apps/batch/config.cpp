// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "config.h"

namespace pcl_flashreg::batch {

std::string
difference(const Config& before, const Config& now)
{
  for (const auto& [key, value] : now.items())
    if (!before.contains(key) || before[key] != value)
      return key + " was " + (before.contains(key) ? before[key].dump() : "not set") +
             ", is " + value.dump();
  for (const auto& [key, value] : before.items())
    if (!now.contains(key))
      return key + " was " + value.dump() + ", is not set";
  return "";
}

} // namespace pcl_flashreg::batch
