// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/impl/stopwatch.hpp>

namespace pcl_flashreg {

/** \brief From a cloud to its descriptors, once for every backend.
 * \tparam Stages a backend's buffers and its form of every step
 */
template <typename Stages>
DescribedCloud
runFeaturePipeline(Stages& stages,
                   const PointView& points,
                   const FeatureParameters& parameters,
                   FeatureTimings& timings)
{
  const auto timed = [](double& milliseconds, const auto& step) {
    const detail::Stopwatch watch;
    step();
    milliseconds = watch.milliseconds();
  };
  timed(timings.voxel_grid, [&] { stages.voxelGrid(points, parameters.voxel_size); });
  timed(timings.neighbor_grid, [&] { stages.neighborGrid(parameters.feature_radius); });
  timed(timings.normals,
        [&] { stages.normals(parameters.normal_radius, parameters.viewpoint); });
  timed(timings.point_histograms,
        [&] { stages.pointHistograms(parameters.feature_radius); });
  timed(timings.feature_histograms,
        [&] { stages.featureHistograms(parameters.feature_radius); });
  return stages.takeResult();
}

} // namespace pcl_flashreg
