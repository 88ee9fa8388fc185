// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief Reads the vertices of a PLY file, and the sensor's pose: all that PCL reads,
 * and what is clear beside that.
 *
 * Ascii, binary little and big endian; scalar properties of any type. List properties
 * and other elements are stepped over. Names become PCL's: nx ny nz are normal_x
 * normal_y normal_z; red green blue (and alpha), where they are bytes, are rgb (rgba).
 * Coordinates are needed; nothing that a file says of anything else is a reason to refuse
 * it. What is left out is in the cloud's notes.
 * - Of several properties of one name the first keeps it, the others become "name_2" and
 *   so on. X, Y and Z are the coordinates where there is no x, y or z.
 * - In ascii, a property that has a number which its type cannot hold becomes float64, one
 *   that has a word which is no number is left out.
 * - The viewpoint is the pose in the element "camera", before or behind the vertices, as
 *   PCL writes it (see takeCamera()), or the origin in PCL's obj_info lines. A file that
 *   is cut off or damaged behind its vertices loses no more than that.
 * \param[in] bytes the whole file
 * \throws InputError if they are not a PLY file, if a coordinate is no number, or if the
 * vertices are cut off
 */
Cloud
parsePly(std::string_view bytes);

/** \brief The cloud as a PLY file, binary_little_endian, with PLY's names. A field of
 * several values becomes as many properties, "name_0", "name_1" and so on. A viewpoint
 * that isn't the default is written as PCL does: in an element "camera", with float32
 * (which PCL reads), or float64 where the coordinates are.
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
