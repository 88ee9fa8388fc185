// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

/** \brief A field as it lies in a PCD file. */
struct PcdField {
  std::string name;
  std::size_t count = 1;
  /** \brief Bytes of one value in a binary body; 0 if the header does not tell. */
  std::size_t value_size = 4;
  /** \brief The type that its values get; none if they are left out. */
  std::optional<ScalarType> kept_as;

  std::size_t
  byteSize() const
  {
    return count * value_size;
  }
};

bool
isCoordinate(const std::string& name);

/** \brief A number of values, bytes or points as PCL takes it from a header: "640.0" and
 * "640," are 640. */
bool
parsePcdCount(std::string_view word, std::size_t& count);

/** \brief The words of the lines FIELDS, SIZE, TYPE and COUNT. */
struct PcdFieldLines {
  std::vector<std::string_view> names, sizes, types, counts;
};

/** \brief All fields that take bytes or words of the body, in its order. The names of
 * those that are kept differ; coordinates are kept.
 * \param[in] body_size bytes of the body, which bound what a point can have
 * \param[in,out] notes what is guessed or left out
 * \throws InputError
 */
std::vector<PcdField>
readPcdFields(const PcdFieldLines& lines,
              std::size_t body_size,
              std::vector<std::string>& notes);

} // namespace pcl_flashreg::io
