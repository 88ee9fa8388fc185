// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "registry.h"

#include "families.h"

#include <algorithm>

namespace pcl_flashreg::evaluate {

const std::vector<MethodEntry>&
methods()
{
  static const std::vector<MethodEntry> all = [] {
    std::vector<MethodEntry> entries;
    for (const auto& family : {
             flashregMethods(),
             denseReferenceMethods(),
             pclMethods(),
#ifdef PCL_FLASHREG_WITH_OPEN3D
             open3dMethods(),
#endif
#ifdef PCL_FLASHREG_WITH_TEASER
             teaserMethods(),
#endif
#ifdef PCL_FLASHREG_WITH_KISS_MATCHER
             kissMatcherMethods(),
#endif
         })
      entries.insert(entries.end(), family.begin(), family.end());
    return entries;
  }();
  return all;
}

const MethodEntry*
findMethod(const std::string& name)
{
  const auto found = std::find_if(methods().begin(),
                                  methods().end(),
                                  [&](const MethodEntry& m) { return m.name == name; });
  return found == methods().end() ? nullptr : &*found;
}

} // namespace pcl_flashreg::evaluate
