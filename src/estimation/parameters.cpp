// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/parameters.h>

#include "support/require.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

void
checkPositive(const char* name, double value)
{
  require(
      value > 0 && std::isfinite(value), name, value, "it must be a finite length > 0");
}

void
checkRange(const char* name, int value, int least, int most)
{
  require(least <= value && value <= most,
          name,
          value,
          "it must lie in [" + std::to_string(least) + ", " + std::to_string(most) +
              "]");
}

void
checkDirection(const char* name, const std::array<float, 3>& direction)
{
  double longest = 0;
  for (const float component : direction) {
    require(std::isfinite(component), name, component, "it must be finite");
    longest = std::max(longest, std::abs(static_cast<double>(component)));
  }
  require(longest > 0, name, longest, "one of its components must not be 0");
}

} // namespace

Parameters
Parameters::fromResolution(double resolution)
{
  checkPositive("resolution", resolution);
  Parameters parameters;
  parameters.length_tolerance = static_cast<float>(0.24 * resolution);
  parameters.min_length_sum = static_cast<float>(3 * resolution);
  parameters.inlier_distance = static_cast<float>(2 * resolution);
  parameters.validate(); // a double that is a zero or an infinity as a float
  return parameters;
}

void
Parameters::validate() const
{
  checkPositive("length_tolerance", length_tolerance);
  require(min_length_sum >= 0 && std::isfinite(min_length_sum),
          "min_length_sum",
          min_length_sum,
          "it must be a finite length >= 0");
  checkPositive("inlier_distance", inlier_distance);
  checkRange("max_correspondences", max_correspondences, 3, 200000);
  checkRange("pivots", pivots, 1, 1000000);
  checkRange("cliques_per_pivot", cliques_per_pivot, 1, 16);
  checkRange("row_capacity", row_capacity, 1, 4096);
  checkRange("pool_capacity", pool_capacity, 1, row_capacity);
  checkRange("second_order", static_cast<int>(second_order), 0, 2);
  checkRange("score_metric", static_cast<int>(score_metric), 0, 2);
  checkRange("refinement_iterations", refinement_iterations, 0, 1000);
  checkRange("max_hypotheses", max_hypotheses, 1, 64);
  checkRange("motion", static_cast<int>(motion), 0, 1);
  require(max_tilt > 0 && max_tilt <= 30,
          "max_tilt",
          max_tilt,
          "it must lie in (0, 30] degrees");
  checkDirection("source_gravity", source_gravity);
  checkDirection("target_gravity", target_gravity);
  require(min_confidence >= 0 && min_confidence <= 1,
          "min_confidence",
          min_confidence,
          "it must lie in [0, 1]");
}

} // namespace pcl_flashreg
