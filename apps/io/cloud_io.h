// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <pcl_flashreg/result.h>

#include <cstddef>
#include <string>

namespace pcl_flashreg::io {

/** \brief Reads a PCD or PLY file, or a raw scan (KITTI's, nuScenes' ...).
 *
 * PCD and PLY are recognised by their first bytes, whatever the file's name; the
 * extension decides where these say nothing.
 * \param[in] raw_row_length values in a row of a raw scan; 0 to tell it from the values
 * \throws InputError if it cannot be read, or holds no points
 */
Cloud
readCloud(const std::string& path, std::size_t raw_row_length = 0);

/** \brief Whether the path's extension stands for a format that readCloud() knows. */
bool
isReadableCloudPath(const std::string& path);

/** \brief Whether the path's extension stands for a format that writeCloud() knows. */
bool
isWritableCloudPath(const std::string& path);

/** \brief Writes a .pcd (binary_compressed) or .ply (binary_little_endian) file, as
 * writeFile() does.
 * \throws InputError if that fails
 */
void
writeCloud(const std::string& path, const Cloud& cloud);

/** \brief Moves the points and the viewpoint, and turns the normals, into another frame.
 * Fields keep their types, except that integer coordinates become floating point. */
void
transformCloud(Cloud& cloud, const RigidTransform& T_new_old);

/** \brief Makes x, y and z doubles. */
void
promoteCoordinates(Cloud& cloud);

} // namespace pcl_flashreg::io
