// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "short_names.h"

#include <algorithm>

namespace pcl_flashreg::map {
namespace {

bool
isDigit(char c)
{
  return c >= '0' && c <= '9';
}

/** \brief Characters that all begin with, not ending within a number. */
std::size_t
commonBeginning(const std::vector<std::string>& names)
{
  std::size_t length = names.front().size();
  for (const std::string& name : names) {
    const auto [end, other] = std::mismatch(
        name.begin(),
        name.begin() + static_cast<std::ptrdiff_t>(std::min(length, name.size())),
        names.front().begin());
    length = static_cast<std::size_t>(end - name.begin());
  }
  while (length > 0 && isDigit(names.front()[length - 1]))
    --length;
  return length;
}

std::vector<std::string>
reversed(std::vector<std::string> names)
{
  for (std::string& name : names)
    std::reverse(name.begin(), name.end());
  return names;
}

} // namespace

std::vector<std::string>
shortNames(const std::vector<std::string>& names)
{
  if (names.size() < 2)
    return names;
  const std::size_t before = commonBeginning(names);
  const std::size_t behind = commonBeginning(reversed(names));
  std::vector<std::string> result;
  for (const std::string& name : names) {
    if (before + behind >= name.size())
      return names;
    result.push_back(name.substr(before, name.size() - before - behind));
  }
  return result;
}

} // namespace pcl_flashreg::map
