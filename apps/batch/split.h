// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <cstddef>
#include <vector>

namespace pcl_flashreg::batch {

/** \brief Part `part` (from 0) of `parts` of a list, in one piece: neighbours in the list
 * mostly share clouds, and each part is to compute the features of few. */
template <typename Item>
std::vector<Item>
partOf(const std::vector<Item>& items, std::size_t part, std::size_t parts)
{
  const std::size_t begin = items.size() * part / parts;
  const std::size_t end = items.size() * (part + 1) / parts;
  return {items.begin() + static_cast<std::ptrdiff_t>(begin),
          items.begin() + static_cast<std::ptrdiff_t>(end)};
}

} // namespace pcl_flashreg::batch
