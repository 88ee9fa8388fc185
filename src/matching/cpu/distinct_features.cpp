// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "matching/cpu/distinct_features.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace pcl_flashreg {
namespace {

/** \brief The largest absolute value, as its bits: those of what is not finite are larger
 * than any finite value's. */
std::int32_t
largestMagnitude(const float* values, std::size_t n)
{
  std::int32_t largest = 0;
  for (std::size_t d = 0; d < n; ++d) {
    std::int32_t bits;
    std::memcpy(&bits, values + d, sizeof(bits));
    largest = std::max(largest, bits & 0x7fffffff);
  }
  return largest;
}

} // namespace

DistinctFeatures::DistinctFeatures(const FeatureView& features) : view(features)
{
  constexpr std::int32_t INFINITE = 0x7f800000;
  finite.reserve(view.size);
  std::int32_t most = 0;
  for (std::size_t i = 0; i < view.size; ++i) {
    const auto row = static_cast<std::int32_t>(i);
    const std::int32_t magnitude = largestMagnitude(of(row), view.dimension);
    if (magnitude >= INFINITE)
      continue;
    finite.push_back(row);
    most = std::max(most, magnitude);
  }
  std::memcpy(&largest, &most, sizeof(largest));
  equal = detail::EqualRows(
      finite.size(), view.dimension, [this](std::size_t i) { return of(finite[i]); });
  findRows();
}

DistinctFeatures::DistinctFeatures(const FeatureView& features,
                                   std::vector<std::int32_t> finite_rows,
                                   detail::EqualRows equal_rows,
                                   float largest_value)
    : view(features),
      finite(std::move(finite_rows)),
      equal(std::move(equal_rows)),
      largest(largest_value)
{
  findRows();
}

void
DistinctFeatures::findRows()
{
  rows.reserve(equal.firsts().size());
  for (const std::uint32_t first : equal.firsts())
    rows.push_back(finite[first]);
}

} // namespace pcl_flashreg
