// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief Reads a PCD file (ascii, binary, binary_compressed): all that PCL reads, and
 * what is clear beside that.
 *
 * Coordinates are needed; nothing that a file says of anything else is a reason to
 * refuse it. What is guessed or left out is in the cloud's notes.
 * - Header. Keywords may stand in any order and in letters of either case; words after
 *   the value of WIDTH, HEIGHT, POINTS or DATA are passed over. Without WIDTH and HEIGHT,
 *   or where they are 0, there are POINTS points; without POINTS, WIDTH x HEIGHT. SIZE,
 *   TYPE and COUNT are 4, F and 1 where they are missing. A VIEWPOINT that is not seven
 *   numbers counts as far as it makes sense.
 * - Fields. Those of COUNT 0 and padding ("_") are left out silently, those of an unknown
 *   TYPE with a note. Half floats (F 2) are kept as float32, truth values (B 1) as bytes.
 *   Of several fields of one name the first keeps it (for coordinates, the first float32,
 *   as in PCL); the others become "name_2" and so on. X, Y and Z are the coordinates where
 *   there is no x, y or z.
 * - Values in ascii. Words are separated by blanks or commas. A field that has a number
 *   which its type cannot hold (300 in a byte, nan in an integer) becomes float64, one
 *   that has a word which is no number is left out. Fields of one byte that are written as
 *   characters are such fields; a character that is a blank or the end of a line costs
 *   the fields after it, too, not the point.
 *
 * Every size that the header declares is checked against the bytes that are there
 * before memory is taken for it.
 * \param[in] bytes the whole file
 * \throws InputError if they are not a PCD file, if a coordinate is no number, or if the
 * file is cut off
 */
Cloud
parsePcd(std::string_view bytes);

/** \brief The cloud as a PCD file, binary_compressed; plain binary where the points
 * take more bytes than the format's 32-bit sizes can say. */
std::string
formatPcd(const Cloud& cloud);

} // namespace pcl_flashreg::io
