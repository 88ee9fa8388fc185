// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pcl_flashreg {

/** \brief The value that this share of the others is not above.
 * \param[in] values at least one; reordered
 * \param[in] share in [0, 1] */
template <typename Value>
Value
quantileOf(std::vector<Value>& values, double share)
{
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(
                                       share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

} // namespace pcl_flashreg
