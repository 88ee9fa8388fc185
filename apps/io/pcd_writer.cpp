// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "lzf.h"
#include "pcd.h"

#include <cstring>
#include <limits>
#include <locale>
#include <sstream>

namespace pcl_flashreg::io {
namespace {

std::string
headerOf(const Cloud& cloud, const char* data)
{
  std::ostringstream names, sizes, types, counts, rest;
  for (std::ostringstream* stream : {&names, &sizes, &types, &counts, &rest})
    stream->imbue(std::locale::classic());
  for (const Field& field : cloud.fields) {
    names << ' ' << field.name;
    sizes << ' ' << sizeOf(field.type);
    types << ' ' << (isFloat(field.type) ? 'F' : isSigned(field.type) ? 'I' : 'U');
    counts << ' ' << field.count;
  }
  rest << "WIDTH " << cloud.width << "\nHEIGHT " << cloud.height << "\nVIEWPOINT";
  rest.precision(std::numeric_limits<double>::max_digits10);
  for (const double value : cloud.viewpoint)
    rest << ' ' << value;
  rest << "\nPOINTS " << cloud.size() << "\nDATA " << data << '\n';
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS" +
         names.str() + "\nSIZE" + sizes.str() + "\nTYPE" + types.str() + "\nCOUNT" +
         counts.str() + '\n' + rest.str();
}

std::vector<std::uint8_t>
columnsOf(const Cloud& cloud)
{
  std::vector<std::uint8_t> columns(cloud.data.size());
  std::uint8_t* to = columns.data();
  for (const Field& field : cloud.fields)
    for (std::size_t i = 0; i < cloud.size(); ++i, to += field.byteSize())
      std::memcpy(to, cloud.point(i) + field.offset, field.byteSize());
  return columns;
}

void
appendSize(std::string& bytes, std::size_t size)
{
  const auto value = static_cast<std::uint32_t>(size);
  char raw[sizeof(value)];
  std::memcpy(raw, &value, sizeof(value));
  bytes.append(raw, sizeof(value));
}

} // namespace

std::string
formatPcd(const Cloud& cloud)
{
  // What does not compress grows by one byte in 32.
  if (cloud.data.size() > std::numeric_limits<std::uint32_t>::max() / 33 * 32) {
    std::string bytes = headerOf(cloud, "binary");
    bytes.append(reinterpret_cast<const char*>(cloud.data.data()), cloud.data.size());
    return bytes;
  }
  const std::vector<std::uint8_t> packed = compressLzf(columnsOf(cloud));
  std::string bytes = headerOf(cloud, "binary_compressed");
  appendSize(bytes, packed.size());
  appendSize(bytes, cloud.data.size());
  bytes.append(reinterpret_cast<const char*>(packed.data()), packed.size());
  return bytes;
}

} // namespace pcl_flashreg::io
