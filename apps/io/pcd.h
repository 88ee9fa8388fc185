// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <string>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief Reads a PCD file (ascii, binary, binary_compressed).
 *
 * Every size that the header declares is checked against the bytes that are there
 * before memory is taken for it. Padding fields ("_") are left out.
 * \param[in] bytes the whole file
 * \throws InputError if they are not a PCD file, or if the file is cut off
 */
Cloud
parsePcd(std::string_view bytes);

/** \brief The cloud as a PCD file, binary_compressed; plain binary where the points
 * take more bytes than the format's 32-bit sizes can say. */
std::string
formatPcd(const Cloud& cloud);

} // namespace pcl_flashreg::io
