// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/export.h>
#include <pcl_flashreg/point_view.h>

namespace pcl_flashreg {

/** \brief A resolution for a cloud that nobody gave one for, in the unit of the cloud.
 *
 * The voxel size at which the middle of the cloud (what is within the middle 80 % on
 * every axis: points far off don't matter) occupies 2500 voxels, or a quarter as many
 * as it has distinct points where that is fewer; rounded to one of 1, 1.25, 1.6, 2,
 * 2.5, 3.15, 4, 5, 6.3, 8 times a power of ten, so that clouds which are nearly alike
 * mostly get the same. That gives about 5 cm for a room, 2.5 mm for a scan of a 15 cm
 * object, 15 cm to 50 cm for a lidar sweep.
 *
 * Points with a coordinate that is not finite are skipped. Time goes with the number of
 * points.
 *
 * \param[in] points the cloud
 * \throws std::invalid_argument if there are fewer than two distinct finite points; if the
 * stride or an index is out of range; if there are more than 2^31 - 1 points
 */
PCL_FLASHREG_EXPORT double
estimateResolution(const PointView& points);

/** \brief The voxel size that a cloud was downsampled with, from its points alone; not
 * rounded, in the unit of the cloud.
 *
 * The voxel size at which the middle of the cloud (see estimateResolution()) occupies
 * 0.65 times as many voxels as it has points, which is right to within about a quarter
 * for clouds from pcl::VoxelGrid.
 *
 * \param[in] points the cloud
 * \throws std::invalid_argument as estimateResolution()
 */
PCL_FLASHREG_EXPORT double
estimateVoxelSize(const PointView& points);

} // namespace pcl_flashreg
