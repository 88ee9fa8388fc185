// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "error.h"
#include "lzf.h"
#include "pcd.h"
#include "pcd_header.h"
#include "text.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_flashreg::io {
namespace {

/** \brief Bytes of a point in the body. */
std::size_t
rowSize(const PcdHeader& header)
{
  std::size_t size = 0;
  for (const PcdField& field : header.fields) {
    if (field.value_size == 0)
      throw InputError("the field " + quoted(field.name) + " has no SIZE");
    size += field.byteSize();
  }
  return size;
}

float
fromHalf(std::uint16_t half)
{
  const int exponent = half >> 10 & 31;
  const int mantissa = half & 1023;
  using Limits = std::numeric_limits<float>;
  float value = std::ldexp(static_cast<float>(mantissa), -24);
  if (exponent == 31)
    value = mantissa == 0 ? Limits::infinity() : Limits::quiet_NaN();
  else if (exponent != 0)
    value = std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
  return half >> 15 == 0 ? value : -value;
}

/** \brief The values of a field of one point, from the file to the cloud. */
void
copyValues(const PcdField& field, const char* from, std::uint8_t* to)
{
  if (field.value_size == sizeOf(*field.kept_as)) {
    std::memcpy(to, from, field.byteSize());
    return;
  }
  for (std::size_t k = 0; k < field.count; ++k) {
    std::uint16_t half;
    std::memcpy(&half, from + k * sizeof(half), sizeof(half));
    const float value = fromHalf(half);
    std::memcpy(to + k * sizeof(value), &value, sizeof(value));
  }
}

/** \brief Where the values of a field lie in the bytes of a body: those of the first
 * point, and how far those of the next one are. */
struct Place {
  const char* first;
  std::size_t stride;
};

/** \brief Fills a cloud from bytes in which place(field, offset) says where a field lies,
 * given the bytes of a point before it. */
template <typename PlaceOf>
void
fill(Cloud& cloud, const PcdHeader& header, PlaceOf&& placeOf)
{
  std::size_t offset = 0;
  std::size_t kept = 0;
  for (const PcdField& field : header.fields) {
    if (field.kept_as) {
      const Place place = placeOf(field, offset);
      const std::size_t to = cloud.fields[kept++].offset;
      for (std::size_t i = 0; i < cloud.size(); ++i)
        copyValues(field, place.first + i * place.stride, cloud.point(i) + to);
    }
    offset += field.byteSize();
  }
}

Cloud
parseBinary(const PcdHeader& header)
{
  const std::size_t row_size = rowSize(header);
  Cloud cloud = makePcdCloud(header, row_size, header.body.size());
  fill(cloud, header, [&](const PcdField&, std::size_t offset) {
    return Place{header.body.data() + offset, row_size};
  });
  return cloud;
}

std::size_t
sizeAt(std::string_view body, std::size_t offset)
{
  std::uint32_t size = 0;
  std::memcpy(&size, body.data() + offset, sizeof(size));
  return size;
}

/** \brief The compressed body has the fields one after the other, each for all points.
 */
Cloud
parseCompressed(const PcdHeader& header)
{
  const std::string_view body = header.body;
  if (body.size() < 8)
    throw InputError("is cut off: the compressed body lacks its sizes");
  const std::size_t compressed = sizeAt(body, 0);
  const std::size_t uncompressed = sizeAt(body, 4);
  if (compressed > body.size() - 8)
    throw InputError("is cut off: the body should have " + std::to_string(compressed) +
                     " bytes and has " + std::to_string(body.size() - 8));
  const std::vector<std::uint8_t> columns =
      decompressLzf(body.substr(8, compressed), uncompressed);
  Cloud cloud = makePcdCloud(header, rowSize(header), columns.size());
  const char* const first = reinterpret_cast<const char*>(columns.data());
  fill(cloud, header, [&](const PcdField& field, std::size_t offset) {
    return Place{first + offset * cloud.size(), field.byteSize()};
  });
  return cloud;
}

/** \brief PCL's older versions take any other word for ascii. */
Cloud
parseUnknown(PcdHeader header)
{
  const std::string complaint =
      "the DATA line says neither ascii, binary nor binary_compressed";
  header.notes.push_back(complaint + ": it is taken for ascii");
  try {
    return readPcdAscii(header);
  }
  catch (const InputError& error) {
    throw InputError(complaint + "; as ascii: " + error.what());
  }
}

} // namespace

Cloud
parsePcd(std::string_view bytes)
{
  PcdHeader header = parsePcdHeader(bytes);
  switch (header.encoding) {
  case PcdEncoding::Ascii:
    return readPcdAscii(std::move(header));
  case PcdEncoding::Binary:
    return parseBinary(header);
  case PcdEncoding::Compressed:
    return parseCompressed(header);
  default:
    return parseUnknown(std::move(header));
  }
}

} // namespace pcl_flashreg::io
