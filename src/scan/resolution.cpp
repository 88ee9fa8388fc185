// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/resolution.h>

#include "scan/cpu/voxel_count.h"
#include "scan/points.h"
#include "scan/scan_maker.h"

#include <algorithm>
#include <cmath>

namespace pcl_flashreg {
namespace {

/** \brief The nearest (in ratio) of ten numbers a decade. */
double
roundToPreferredNumber(double value)
{
  constexpr double STEPS[] = {1, 1.25, 1.6, 2, 2.5, 3.15, 4, 5, 6.3, 8, 10};
  // Powers of ten are exact upwards only, so that dividing by one gives the double that is
  // printed as it is meant.
  const double exponent = std::floor(std::log10(value));
  const double power = std::pow(10.0, std::abs(exponent));
  const auto scaled = [&](double step) {
    return exponent < 0 ? step / power : step * power;
  };
  const auto distance = [&](double step) {
    return std::abs(std::log(value / scaled(step)));
  };
  double best = STEPS[0];
  for (const double step : STEPS)
    if (distance(step) < distance(best))
      best = step;
  return scaled(best);
}

} // namespace

CloudScale
scaleOf(const PointView& points)
{
  check(points);
  const cpu::VoxelCount voxels(points);
  const double quarter = 0.25 * static_cast<double>(voxels.distinctPoints());
  return {
      roundToPreferredNumber(voxels.sizeFor(std::max(2.0, std::min(2500.0, quarter)))),
      voxels.extent()};
}

double
estimateResolution(const PointView& points)
{
  return scaleOf(points).resolution;
}

double
estimateVoxelSize(const PointView& points)
{
  check(points);
  // Centroids of pcl::VoxelGrid on surfaces occupy this share of the voxels of a grid
  // of the same size that is shifted against it.
  constexpr double OCCUPIED_SHARE = 0.65;
  const cpu::VoxelCount voxels(points);
  const auto distinct = static_cast<double>(voxels.distinctPoints());
  return voxels.sizeFor(std::max(2.0, OCCUPIED_SHARE * distinct));
}

} // namespace pcl_flashreg
