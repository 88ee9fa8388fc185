// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <cstddef>
#include <string_view>

namespace pcl_flashreg::io {

/** \brief The longest row that a raw file may be said to have. */
constexpr std::size_t kMaxRawFields = 64;

/** \brief Reads a scan that is nothing but rows of float32, x y z and what the sensor has
 * to say besides: KITTI's (intensity), nuScenes' (intensity and ring), and others.
 *
 * A fourth value is the field "intensity" in rows of four and five, a fifth "ring" where
 * it can be one; others are "field_3", "field_4" and so on.
 * \param[in] row_length values in a row, 3 to kMaxRawFields; 0 to tell it from the values.
 * Where it is told and isn't KITTI's, the cloud's notes say so.
 * \throws InputError if the bytes cannot be that, or if nothing tells the length of a row
 */
Cloud
parseRawBin(std::string_view bytes, std::size_t row_length = 0);

} // namespace pcl_flashreg::io
