// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief Reads the vertices of a PLY file.
 *
 * Ascii, binary little and big endian; scalar properties of any type. List properties
 * and other elements are stepped over. Names become PCL's: nx ny nz are normal_x
 * normal_y normal_z; red green blue (and alpha), where they are bytes, are rgb (rgba).
 * \param[in] bytes the whole file
 * \throws InputError if they are not a PLY file, or if the file is cut off
 */
Cloud
parsePly(std::string_view bytes);

/** \brief The cloud as a PLY file, binary_little_endian, with PLY's names. A field of
 * several values becomes as many properties, "name_0", "name_1" and so on.
 * \throws InputError if a field is a 64-bit integer, which PLY does not have
 */
std::string
formatPly(const Cloud& cloud);

/** \brief PLY's property names to PCL's field names. */
Cloud
toPclFields(Cloud cloud);

/** \brief PCL's field names to PLY's property names. */
Cloud
toPlyFields(Cloud cloud);

} // namespace pcl_flashreg::io
