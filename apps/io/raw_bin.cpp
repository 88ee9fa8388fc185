// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "raw_bin.h"

#include "error.h"
#include "row_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>

namespace pcl_flashreg::io {
namespace {

constexpr std::size_t kKittiLength = 4;
// Fewer values are no scan that could be registered, and tell little.
constexpr std::size_t kFewValues = 400;
// No laser sees further than this, while arbitrary bytes make numbers of any size.
constexpr double kFarthest = 1e5;

std::string
inBytes(std::size_t row_length)
{
  return std::to_string(row_length * sizeof(float)) + " bytes (" +
         std::to_string(row_length) + " float32 a row)";
}

/** \brief What else the bytes are, by how they begin; empty if they may be numbers. */
std::string
otherFormat(std::string_view bytes)
{
  using namespace std::string_view_literals;
  constexpr std::array<std::pair<std::string_view, const char*>, 4> magics = {
      {{"\x93NUMPY"sv, "a NumPy file (.npy)"},
       {"PK\x03\x04"sv, "a zip archive"},
       {"\x1f\x8b\x08"sv, "a gzip archive"},
       {"LASF"sv, "a LAS file"}}};
  for (const auto& [magic, name] : magics)
    if (bytes.substr(0, magic.size()) == magic)
      return name;
  const std::string_view beginning = bytes.substr(0, 256);
  const auto is_text = [](char c) {
    return (c >= ' ' && c <= '~') || (c >= '\t' && c <= '\r');
  };
  return std::all_of(beginning.begin(), beginning.end(), is_text) ? "text" : "";
}

/** \brief Whether nearly all values make sense as doubles: coordinates, or what comes
 * with them, are neither tiny nor huge, nor all 0. */
bool
lookLikeDoubles(std::string_view bytes)
{
  const std::size_t n = bytes.size() / sizeof(double);
  std::size_t sensible = 0, zeros = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double value = 0;
    std::memcpy(&value, bytes.data() + i * sizeof(double), sizeof(double));
    const double size = std::abs(value);
    zeros += size == 0 ? 1 : 0;
    sensible += size > 1e-6 && size < 1e8 ? 1 : 0;
  }
  return bytes.size() % sizeof(double) == 0 && sensible > 0 &&
         (sensible + zeros) * 100 >= n * 99;
}

[[noreturn]] void
failUnknown(std::string_view bytes, const std::string& why)
{
  throw InputError(lookLikeDoubles(bytes)
                       ? "seems to hold float64 values; raw scans are rows of float32"
                       : why);
}

/** \brief The length of a row, as it is told by the values. */
std::size_t
recognisedLength(std::string_view bytes)
{
  const std::size_t told = rowLengthOf(bytes);
  const bool kitti = bytes.size() % (kKittiLength * sizeof(float)) == 0;
  if (told == 0 && kitti && bytes.size() < kFewValues * sizeof(float))
    return kKittiLength;
  if (told == 0)
    failUnknown(bytes,
                "is no scan whose layout can be told: raw .bin files are rows of "
                "float32, x y z intensity as KITTI's or x y z intensity ring as "
                "nuScenes'; --bin-fields N states how many a row has");
  if (bytes.size() % (told * sizeof(float)) != 0)
    failUnknown(bytes,
                "is cut off, or another layout than it seems: its size is no multiple "
                "of " +
                    inBytes(told) + "; --bin-fields N states how many a row has");
  return told;
}

/** \brief Whether the values of a field are small counts, as the number of a laser is. */
bool
canBeRing(const Cloud& cloud, const Field& field)
{
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const double value = loadValue(cloud.point(i), field);
    if (!(value >= 0 && value < 1024 && value == std::floor(value)))
      return false;
  }
  return true;
}

Cloud
cloudOf(std::string_view bytes, std::size_t row_length)
{
  Cloud cloud;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, ScalarType::Float32);
  for (std::size_t k = 3; k < row_length; ++k)
    cloud.addField("field_" + std::to_string(k), ScalarType::Float32);
  cloud.width = bytes.size() / cloud.point_size;
  cloud.data.assign(bytes.begin(), bytes.end());
  if (row_length == 4 || row_length == 5)
    cloud.fields[3].name = "intensity";
  if (row_length == 5 && canBeRing(cloud, cloud.fields[4]))
    cloud.fields[4].name = "ring";
  return cloud;
}

void
checkCoordinates(const Cloud& cloud, std::string_view bytes)
{
  bool has_x = false;
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = loadValue(cloud.point(i), cloud.fields[k]);
      has_x = has_x || (k == 0 && value != 0);
      if (std::abs(value) > kFarthest)
        failUnknown(bytes,
                    "is no raw scan: point " + std::to_string(i) +
                        " lies more than 100 km away");
    }
  // Doubles that need few digits have nothing but zeros in every other float32.
  if (!has_x && lookLikeDoubles(bytes))
    failUnknown(bytes, "");
}

std::string
noteOn(const Cloud& cloud)
{
  std::string names;
  for (const Field& field : cloud.fields)
    names += (names.empty() ? "" : " ") + field.name;
  return "read as rows of " + std::to_string(cloud.fields.size()) + " float32 (" +
         names + "), as its values tell; --bin-fields N states another length";
}

} // namespace

Cloud
parseRawBin(std::string_view bytes, std::size_t row_length)
{
  const std::string other = otherFormat(bytes);
  if (!other.empty())
    throw InputError("is " + other + ", not rows of float32 as a raw scan is");
  const std::size_t length = row_length != 0 ? row_length : recognisedLength(bytes);
  if (bytes.size() % (length * sizeof(float)) != 0)
    throw InputError("is no raw scan, or cut off: its size is no multiple of " +
                     inBytes(length));
  Cloud cloud = cloudOf(bytes, length);
  checkCoordinates(cloud, bytes);
  if (row_length == 0 && length != kKittiLength)
    cloud.notes.push_back(noteOn(cloud));
  return cloud;
}

} // namespace pcl_flashreg::io
