// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cloud.h"

#include "error.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_flashreg::io {
namespace {

// Files have a few dozen at most; names are looked up one after the other.
constexpr std::size_t kMaxFields = 4096;

template <typename T>
double
load(const std::uint8_t* from)
{
  T value;
  std::memcpy(&value, from, sizeof(T));
  return static_cast<double>(value);
}

template <typename T>
T
convert(double value)
{
  using Limits = std::numeric_limits<T>;
  if constexpr (std::is_same_v<T, float>) {
    if (std::isfinite(value) && std::abs(value) > Limits::max())
      return std::copysign(Limits::infinity(),
                           static_cast<float>(std::copysign(1, value)));
    return static_cast<float>(value);
  }
  else if constexpr (std::is_same_v<T, double>) {
    return value;
  }
  else {
    // The largest 64-bit integers are no doubles: their conversion rounds up to 2^64 or
    // 2^63, hence >=.
    if (std::isnan(value))
      return 0;
    const double rounded = std::nearbyint(value);
    if (rounded >= static_cast<double>(Limits::max()))
      return Limits::max();
    if (rounded <= static_cast<double>(Limits::min()))
      return Limits::min();
    return static_cast<T>(rounded);
  }
}

template <typename T>
void
store(std::uint8_t* to, double value)
{
  const T converted = convert<T>(value);
  std::memcpy(to, &converted, sizeof(T));
}

} // namespace

std::size_t
sizeOf(ScalarType type)
{
  switch (type) {
  case ScalarType::Int8:
  case ScalarType::Uint8:
    return 1;
  case ScalarType::Int16:
  case ScalarType::Uint16:
    return 2;
  case ScalarType::Int32:
  case ScalarType::Uint32:
  case ScalarType::Float32:
    return 4;
  default:
    return 8;
  }
}

bool
isFloat(ScalarType type)
{
  return type == ScalarType::Float32 || type == ScalarType::Float64;
}

bool
isSigned(ScalarType type)
{
  return type == ScalarType::Int8 || type == ScalarType::Int16 ||
         type == ScalarType::Int32 || type == ScalarType::Int64;
}

const Field*
Cloud::find(const std::string& name) const
{
  const auto it = std::find_if(
      fields.begin(), fields.end(), [&](const Field& f) { return f.name == name; });
  return it == fields.end() ? nullptr : &*it;
}

void
Cloud::addField(const std::string& name, ScalarType type, std::size_t count)
{
  if (find(name) != nullptr)
    throw InputError("the field '" + name + "' is declared twice");
  if (fields.size() == kMaxFields)
    throw InputError("more than " + std::to_string(kMaxFields) +
                     " fields are declared");
  fields.push_back({name, type, count, point_size});
  point_size += fields.back().byteSize();
}

double
loadValue(const std::uint8_t* point, const Field& field, std::size_t k)
{
  const std::uint8_t* from = point + field.offset + k * sizeOf(field.type);
  switch (field.type) {
  case ScalarType::Int8:
    return load<std::int8_t>(from);
  case ScalarType::Uint8:
    return load<std::uint8_t>(from);
  case ScalarType::Int16:
    return load<std::int16_t>(from);
  case ScalarType::Uint16:
    return load<std::uint16_t>(from);
  case ScalarType::Int32:
    return load<std::int32_t>(from);
  case ScalarType::Uint32:
    return load<std::uint32_t>(from);
  case ScalarType::Int64:
    return load<std::int64_t>(from);
  case ScalarType::Uint64:
    return load<std::uint64_t>(from);
  case ScalarType::Float32:
    return load<float>(from);
  default:
    return load<double>(from);
  }
}

void
storeValue(std::uint8_t* point, const Field& field, double value, std::size_t k)
{
  std::uint8_t* to = point + field.offset + k * sizeOf(field.type);
  switch (field.type) {
  case ScalarType::Int8:
    return store<std::int8_t>(to, value);
  case ScalarType::Uint8:
    return store<std::uint8_t>(to, value);
  case ScalarType::Int16:
    return store<std::int16_t>(to, value);
  case ScalarType::Uint16:
    return store<std::uint16_t>(to, value);
  case ScalarType::Int32:
    return store<std::int32_t>(to, value);
  case ScalarType::Uint32:
    return store<std::uint32_t>(to, value);
  case ScalarType::Int64:
    return store<std::int64_t>(to, value);
  case ScalarType::Uint64:
    return store<std::uint64_t>(to, value);
  case ScalarType::Float32:
    return store<float>(to, value);
  default:
    return store<double>(to, value);
  }
}

Cloud
withFields(const Cloud& cloud, const std::vector<Field>& fields)
{
  Cloud copy;
  for (const Field& field : fields)
    copy.addField(field.name, field.type, field.count);
  copy.width = cloud.width;
  copy.height = cloud.height;
  copy.viewpoint = cloud.viewpoint;
  copy.notes = cloud.notes;
  copy.data.assign(cloud.size() * copy.point_size, 0);
  for (const Field& to : copy.fields) {
    const Field* from = cloud.find(to.name);
    if (from == nullptr)
      continue;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
      if (from->type == to.type && from->count == to.count)
        std::memcpy(
            copy.point(i) + to.offset, cloud.point(i) + from->offset, to.byteSize());
      else
        for (std::size_t k = 0; k < std::min(from->count, to.count); ++k)
          storeValue(copy.point(i), to, loadValue(cloud.point(i), *from, k), k);
    }
  }
  return copy;
}

Eigen::Matrix3Xd
coordinates(const Cloud& cloud)
{
  Eigen::Matrix3Xd xyz(3, static_cast<Eigen::Index>(cloud.size()));
  const char* const names[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis) {
    const Field* field = cloud.find(names[axis]);
    if (field == nullptr)
      throw InputError(std::string("has no field '") + names[axis] +
                       "': it is not a point cloud");
    for (std::size_t i = 0; i < cloud.size(); ++i)
      xyz(axis, static_cast<Eigen::Index>(i)) = loadValue(cloud.point(i), *field);
  }
  return xyz;
}

} // namespace pcl_flashreg::io
