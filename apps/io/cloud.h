// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pcl_flashreg::io {

/** \brief What PCD and PLY files can hold in a field. */
enum class ScalarType : std::uint8_t {
  Int8,
  Uint8,
  Int16,
  Uint16,
  Int32,
  Uint32,
  Int64,
  Uint64,
  Float32,
  Float64
};

/** \brief Bytes of one value. */
std::size_t
sizeOf(ScalarType type);

bool
isFloat(ScalarType type);

bool
isSigned(ScalarType type);

/** \brief One named value, or a row of them (a histogram), of every point. */
struct Field {
  std::string name;
  ScalarType type = ScalarType::Float32;
  std::size_t count = 1;
  /** \brief Bytes from the start of a point. */
  std::size_t offset = 0;

  std::size_t
  byteSize() const
  {
    return count * sizeOf(type);
  }
};

/** \brief A cloud with all the fields of its file, in their own types. Field names are
 * PCL's ("normal_x", "rgb") whatever the file's format. */
struct Cloud {
  std::vector<Field> fields;
  /** \brief Bytes of one point. */
  std::size_t point_size = 0;
  std::size_t width = 0;
  std::size_t height = 1;
  /** \brief width * height points one after the other, without padding, in the byte
   * order of this machine. */
  std::vector<std::uint8_t> data;
  /** \brief PCD's VIEWPOINT: tx ty tz qw qx qy qz. */
  std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0};
  /** \brief What people should know of how the file was read, one line each. */
  std::vector<std::string> notes;

  std::size_t
  size() const
  {
    return width * height;
  }

  const std::uint8_t*
  point(std::size_t i) const
  {
    return data.data() + i * point_size;
  }

  std::uint8_t*
  point(std::size_t i)
  {
    return data.data() + i * point_size;
  }

  /** \brief The field of that name, or null. */
  const Field*
  find(const std::string& name) const;

  /** \brief Appends a field to the layout; only before there is data.
   * \throws InputError if the name is taken, or if there are too many fields
   */
  void
  addField(const std::string& name, ScalarType type, std::size_t count = 1);
};

/** \brief Value k of a field of one point, as a double. */
double
loadValue(const std::uint8_t* point, const Field& field, std::size_t k = 0);

/** \brief The reverse: rounds to the field's type; out of range becomes the nearest
 * value (infinity for floats), NaN becomes 0 in an integer. */
void
storeValue(std::uint8_t* point, const Field& field, double value, std::size_t k = 0);

/** \brief A copy with another layout: fields are taken over by name, converted to the
 * new type where it differs; fields that the cloud lacks are 0. */
Cloud
withFields(const Cloud& cloud, const std::vector<Field>& fields);

/** \brief Coordinates, one column a point (N x 3 row-major in memory).
 * \throws InputError if the cloud lacks one of x, y, z
 */
Eigen::Matrix3Xd
coordinates(const Cloud& cloud);

} // namespace pcl_flashreg::io
