// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <pcl_flashreg/result.h>

#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief Reads a .pcd, .ply or KITTI .bin file.
 *
 * A file of another name is recognised by its first bytes.
 * \throws InputError if it cannot be read, or holds no points
 */
Cloud
readCloud(const std::string& path);

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

/** \brief Reads a KITTI scan: float32 x y z intensity, and nothing else.
 * \throws InputError if the bytes cannot be that
 */
Cloud
parseKittiBin(std::string_view bytes);

/** \brief Moves the points and the viewpoint, and turns the normals, into another frame.
 * Fields keep their types, except that integer coordinates become floating point. */
void
transformCloud(Cloud& cloud, const RigidTransform& T_new_old);

/** \brief Makes x, y and z doubles. */
void
promoteCoordinates(Cloud& cloud);

} // namespace pcl_flashreg::io
