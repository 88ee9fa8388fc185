// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

struct PlyProperty {
  std::string name;
  ScalarType type = ScalarType::Float32;
  /** \brief Type of the list's length; none for a scalar. */
  std::optional<ScalarType> list_length;
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
  /** \brief Why its rows cannot be read; empty if they can. Behind the vertices that
   * does no harm. */
  std::string fault;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::Ascii;
  std::vector<PlyElement> elements;
  /** \brief Where the sensor stood, as PCL's writer states it where it writes no camera.
   */
  std::optional<std::array<double, 3>> origin;
  /** \brief Bytes before the body. */
  std::size_t size = 0;
};

/** \brief Reads the header of a PLY file; lines with an unknown keyword are skipped, as
 * PCL skips them.
 * \throws InputError if there is none, or if it is cut off
 */
PlyHeader
parsePlyHeader(std::string_view bytes);

} // namespace pcl_flashreg::io
