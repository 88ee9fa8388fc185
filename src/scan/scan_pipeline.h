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

  const float*
  of(std::size_t point) const
  {
    return data + point * stride;
  }
};

/** \brief Runs a step and books its time. */
template <typename Step>
void
timeStep(double& milliseconds, const Step& step)
{
  const detail::Stopwatch watch;
  step();
  milliseconds = watch.milliseconds();
}

/** \brief From a cloud to its keypoints with normals of either sign, once for every
 * backend; the result stays in the stages.
 * \tparam Stages a backend's buffers and its form of every step
 */
template <typename Stages>
void
findSurface(Stages& stages,
            const PointView& points,
            const GivenNormals& normals,
            const FeatureParameters& parameters,
            ScanContent content,
            FeatureTimings& timings)
{
  const double reach = content == ScanContent::Descriptors ? parameters.feature_radius
                                                           : parameters.normal_radius;
  timeStep(timings.voxel_grid,
           [&] { stages.voxelGrid(points, parameters.voxel_size); });
  timeStep(timings.neighbor_grid, [&] { stages.neighborGrid(reach); });
  timeStep(timings.normals,
           [&] { stages.normals(points, normals, parameters.normal_radius); });
}

/** \brief From keypoints whose normals have been turned to their descriptors. */
template <typename Stages>
void
describeSurface(Stages& stages,
                const FeatureParameters& parameters,
                FeatureTimings& timings)
{
  timeStep(timings.point_histograms,
           [&] { stages.pointHistograms(parameters.feature_radius); });
  timeStep(timings.feature_histograms,
           [&] { stages.featureHistograms(parameters.feature_radius); });
}

} // namespace pcl_flashreg
