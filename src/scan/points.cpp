// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "scan/points.h"

#include "support/require.h"

#include <cstdint>
#include <limits>
#include <string>

namespace pcl_flashreg {

template <typename Scalar>
void
check(const BasicPointView<Scalar>& points)
{
  constexpr auto MOST =
      static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max());
  require(points.size <= MOST, "points.size", points.size, "it must fit 31 bits");
  require(points.index_count <= MOST,
          "points.index_count",
          points.index_count,
          "it must fit 31 bits");
  require(points.size == 0 || (points.data && points.stride >= 3),
          "points.stride",
          points.stride,
          "points need data and a stride >= 3");
  for (std::size_t i = 0; points.indices && i < points.index_count; ++i) {
    const std::int32_t index = points.indices[i];
    if (index < 0 || static_cast<std::size_t>(index) >= points.size)
      throw std::invalid_argument("index " + std::to_string(index) +
                                  " is not one of a cloud of " +
                                  std::to_string(points.size) + " points");
  }
}

template void
check(const BasicPointView<float>&);
template void
check(const BasicPointView<double>&);

} // namespace pcl_flashreg
