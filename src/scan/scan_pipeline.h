// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_extractor.h>
#include <pcl_flashreg/impl/stopwatch.hpp>
#include <pcl_flashreg/scan.h>

namespace pcl_flashreg {

/** \brief Normals that came with the points; one a point of the whole cloud. */
struct GivenNormals {
  /** \brief Null where there are none. */
  const float* data = nullptr;
  std::size_t stride = 3;
  /** \brief Whether to turn them to the viewpoint, as computed ones always are. */
  bool orient = false;

  const float*
  of(std::size_t point) const
  {
    return data + point * stride;
  }
};

/** \brief From a cloud to its keypoints, their normals and descriptors, once for every
 * backend; the result stays in the stages.
 * \tparam Stages a backend's buffers and its form of every step
 */
template <typename Stages>
void
runScanPipeline(Stages& stages,
                const PointView& points,
                const GivenNormals& normals,
                const FeatureParameters& parameters,
                ScanContent content,
                FeatureTimings& timings)
{
  const auto timed = [](double& milliseconds, const auto& step) {
    const detail::Stopwatch watch;
    step();
    milliseconds = watch.milliseconds();
  };
  const bool describe = content == ScanContent::Descriptors;
  const double reach = describe ? parameters.feature_radius : parameters.normal_radius;
  timed(timings.voxel_grid, [&] { stages.voxelGrid(points, parameters.voxel_size); });
  timed(timings.neighbor_grid, [&] { stages.neighborGrid(reach); });
  timed(timings.normals, [&] {
    stages.normals(points, normals, parameters.normal_radius, parameters.viewpoint);
  });
  if (!describe)
    return;
  timed(timings.point_histograms,
        [&] { stages.pointHistograms(parameters.feature_radius); });
  timed(timings.feature_histograms,
        [&] { stages.featureHistograms(parameters.feature_radius); });
}

} // namespace pcl_flashreg
