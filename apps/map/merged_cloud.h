// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

/** \brief A scan's file, and where the scan is. */
struct MapInput {
  std::string path;
  RigidTransform T_map_scan;
};

/** \brief Writes the points of all files into one, in one frame, one point a voxel.
 *
 * Of the points in a voxel the one nearest to its middle is kept, the first of equally near
 * ones: a point that was measured, with all that was measured of it. Fields that all files
 * have are kept, normals are turned. Coordinates are doubles where those of a file are, or
 * where the map is too large for single precision. Points with a coordinate that is not
 * finite are skipped.
 *
 * Files are read one after the other: there are never more points in memory than those of
 * one file and those that are kept.
 * \param[in] leaf edge of a voxel, > 0, in the unit of the scans
 * \param[in] output path of a .pcd or .ply file, written as io::writeCloud() does
 * \param[in] raw_row_length as for io::readCloud()
 * \return number of points written
 * \throws std::invalid_argument if the leaf is out of range
 * \throws io::InputError if a file can't be read or written, if there is no point
 */
std::size_t
writeMergedCloud(const std::vector<MapInput>& scans,
                 double leaf,
                 const std::string& output,
                 std::size_t raw_row_length = 0);

} // namespace pcl_flashreg::map
