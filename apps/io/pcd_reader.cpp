// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "error.h"
#include "lzf.h"
#include "pcd.h"
#include "text.h"

#include <cstring>
#include <limits>
#include <optional>

namespace pcl_flashreg::io {
namespace {

using Words = std::vector<std::string_view>;

/** \brief The header's lines as they are written, before they are checked. */
struct Header {
  Words names, sizes, types, counts;
  std::optional<std::size_t> width, height, points;
  std::array<double, 7> viewpoint = {0, 0, 0, 1, 0, 0, 0};
  std::string_view data;
  std::size_t body = 0;
  std::size_t body_line = 0;
};

std::string
quoted(std::string_view text)
{
  return "'" + std::string(text.substr(0, 40)) + "'";
}

[[noreturn]] void
failAt(std::size_t line, const std::string& message)
{
  throw InputError("line " + std::to_string(line) + ": " + message);
}

std::size_t
headerNumber(const Words& words, std::size_t line)
{
  std::size_t value = 0;
  if (words.size() != 2 || !parseUnsigned(words[1], value))
    failAt(line, "expected one number after " + quoted(words[0]));
  return value;
}

void
parseViewpoint(const Words& words, std::size_t line, std::array<double, 7>& viewpoint)
{
  if (words.size() != 8)
    failAt(line, "expected seven numbers after VIEWPOINT");
  for (std::size_t i = 0; i < 7; ++i)
    if (!parseDouble(words[i + 1], viewpoint[i]))
      failAt(line, quoted(words[i + 1]) + " is not a number");
}

Header
parseHeader(std::string_view bytes)
{
  Header header;
  LineReader lines(bytes);
  for (std::string_view line; lines.next(line);) {
    const Words words = splitWords(line);
    if (words.empty() || words[0][0] == '#')
      continue;
    const std::string_view key = words[0];
    const Words rest(words.begin() + 1, words.end());
    if (key == "FIELDS" || key == "COLUMNS")
      header.names = rest;
    else if (key == "SIZE")
      header.sizes = rest;
    else if (key == "TYPE")
      header.types = rest;
    else if (key == "COUNT")
      header.counts = rest;
    else if (key == "WIDTH")
      header.width = headerNumber(words, lines.lineNumber());
    else if (key == "HEIGHT")
      header.height = headerNumber(words, lines.lineNumber());
    else if (key == "POINTS")
      header.points = headerNumber(words, lines.lineNumber());
    else if (key == "VIEWPOINT")
      parseViewpoint(words, lines.lineNumber(), header.viewpoint);
    else if (key == "DATA") {
      header.data = words.size() == 2 ? words[1] : std::string_view();
      header.body = lines.position();
      header.body_line = lines.lineNumber();
      return header;
    }
    else if (key != "VERSION")
      failAt(lines.lineNumber(), "not a PCD header: unknown keyword " + quoted(key));
  }
  throw InputError("the header has no DATA line: not a PCD file, or cut off");
}

ScalarType
scalarType(std::string_view type, std::string_view size)
{
  const char kind = type.size() == 1 ? type[0] : ' ';
  if (kind == 'F' && size == "4")
    return ScalarType::Float32;
  if (kind == 'F' && size == "8")
    return ScalarType::Float64;
  if (kind == 'I' || kind == 'U') {
    const bool is_signed = kind == 'I';
    if (size == "1")
      return is_signed ? ScalarType::Int8 : ScalarType::Uint8;
    if (size == "2")
      return is_signed ? ScalarType::Int16 : ScalarType::Uint16;
    if (size == "4")
      return is_signed ? ScalarType::Int32 : ScalarType::Uint32;
    if (size == "8")
      return is_signed ? ScalarType::Int64 : ScalarType::Uint64;
  }
  throw InputError("a field has the unknown TYPE " + quoted(type) + " with SIZE " +
                   quoted(size));
}

/** \brief A field and whether it is kept. */
struct FileField : Field {
  bool padding = false;
};

std::vector<FileField>
fieldsOf(const Header& header, std::size_t body_size)
{
  const std::size_t n = header.names.size();
  if (n == 0)
    throw InputError("the header has no FIELDS line");
  const auto matches = [&](const Words& words) {
    return words.empty() || words.size() == n;
  };
  if (!matches(header.sizes) || !matches(header.types) || !matches(header.counts))
    throw InputError(
        "FIELDS, SIZE, TYPE and COUNT do not have the same number of entries");
  std::vector<FileField> fields(n);
  for (std::size_t i = 0; i < n; ++i) {
    FileField& field = fields[i];
    field.name = std::string(header.names[i]);
    field.padding = field.name == "_";
    field.type = scalarType(header.types.empty() ? "F" : header.types[i],
                            header.sizes.empty() ? "4" : header.sizes[i]);
    // One value takes a byte of the file at least (in ascii, in binary, and in LZF one
    // byte in 88), which bounds what a count can be.
    if (!header.counts.empty() && (!parseUnsigned(header.counts[i], field.count) ||
                                   field.count == 0 || field.count / 100 > body_size))
      throw InputError("the field " + quoted(field.name) +
                       " has the impossible COUNT " + quoted(header.counts[i]));
  }
  return fields;
}

/** \brief Gives the cloud its fields and its size; throws where the points cannot be in
 * a body that could hold so many bytes. */
Cloud
layoutOf(const Header& header,
         const std::vector<FileField>& fields,
         std::size_t row_size,
         std::size_t capacity)
{
  Cloud cloud;
  cloud.viewpoint = header.viewpoint;
  for (const FileField& field : fields)
    if (!field.padding)
      cloud.addField(field.name, field.type, field.count);
  cloud.width = header.width.value_or(header.points.value_or(0));
  cloud.height = header.height.value_or(1);
  const std::size_t limit = capacity / row_size;
  if (cloud.height != 0 &&
      cloud.width > std::numeric_limits<std::size_t>::max() / cloud.height)
    throw InputError("WIDTH x HEIGHT is impossibly large");
  if (header.points && *header.points != cloud.size())
    throw InputError("POINTS is " + std::to_string(*header.points) +
                     ", but WIDTH x HEIGHT is " + std::to_string(cloud.size()));
  if (cloud.size() > limit)
    throw InputError("is cut off: the header declares " + std::to_string(cloud.size()) +
                     " points, the body holds " + std::to_string(limit) + " at most");
  cloud.data.resize(cloud.size() * cloud.point_size);
  return cloud;
}

std::size_t
binaryRowSize(const std::vector<FileField>& fields)
{
  std::size_t size = 0;
  for (const FileField& field : fields)
    size += field.byteSize();
  return size;
}

Cloud
parseAscii(const Header& header,
           const std::vector<FileField>& fields,
           std::string_view body)
{
  std::size_t values = 0;
  for (const FileField& field : fields)
    values += field.count;
  // A value is one character and a blank or line end; the last one may lack that.
  Cloud cloud = layoutOf(header, fields, 2 * values, body.size() + 1);
  LineReader lines(body);
  std::size_t i = 0;
  for (std::string_view line; i < cloud.size() && lines.next(line);) {
    const Words words = splitWords(line);
    if (words.empty() || words[0][0] == '#')
      continue;
    const std::size_t number = header.body_line + lines.lineNumber();
    if (words.size() != values)
      failAt(number,
             "expected " + std::to_string(values) + " values, found " +
                 std::to_string(words.size()));
    std::size_t word = 0;
    std::size_t kept = 0;
    for (const FileField& field : fields) {
      if (field.padding) {
        word += field.count;
        continue;
      }
      const Field& to = cloud.fields[kept++];
      for (std::size_t k = 0; k < to.count; ++k, ++word)
        if (!storeWord(words[word], cloud.point(i), to, k))
          failAt(number,
                 quoted(words[word]) + " is no value for the field " + quoted(to.name));
    }
    ++i;
  }
  if (i < cloud.size())
    throw InputError("is cut off: the header declares " + std::to_string(cloud.size()) +
                     " points, the body holds " + std::to_string(i));
  return cloud;
}

Cloud
parseBinary(const Header& header,
            const std::vector<FileField>& fields,
            std::string_view body)
{
  const std::size_t row_size = binaryRowSize(fields);
  Cloud cloud = layoutOf(header, fields, row_size, body.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const char* from = body.data() + i * row_size;
    std::uint8_t* to = cloud.point(i);
    for (const FileField& field : fields) {
      if (!field.padding) {
        std::memcpy(to, from, field.byteSize());
        to += field.byteSize();
      }
      from += field.byteSize();
    }
  }
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
parseCompressed(const Header& header,
                const std::vector<FileField>& fields,
                std::string_view body)
{
  if (body.size() < 8)
    throw InputError("is cut off: the compressed body lacks its sizes");
  const std::size_t compressed = sizeAt(body, 0);
  const std::size_t uncompressed = sizeAt(body, 4);
  if (compressed > body.size() - 8)
    throw InputError("is cut off: the body should have " + std::to_string(compressed) +
                     " bytes and has " + std::to_string(body.size() - 8));
  const std::vector<std::uint8_t> columns =
      decompressLzf(body.substr(8, compressed), uncompressed);
  Cloud cloud = layoutOf(header, fields, binaryRowSize(fields), columns.size());
  const std::uint8_t* from = columns.data();
  std::size_t offset = 0;
  for (const FileField& field : fields) {
    const std::size_t size = field.byteSize();
    if (!field.padding) {
      for (std::size_t i = 0; i < cloud.size(); ++i)
        std::memcpy(cloud.point(i) + offset, from + i * size, size);
      offset += size;
    }
    from += cloud.size() * size;
  }
  return cloud;
}

} // namespace

Cloud
parsePcd(std::string_view bytes)
{
  const Header header = parseHeader(bytes);
  const std::string_view body = bytes.substr(header.body);
  const std::vector<FileField> fields = fieldsOf(header, body.size());
  if (header.data == "ascii")
    return parseAscii(header, fields, body);
  if (header.data == "binary")
    return parseBinary(header, fields, body);
  if (header.data == "binary_compressed")
    return parseCompressed(header, fields, body);
  throw InputError("the DATA line says neither ascii, binary nor binary_compressed");
}

} // namespace pcl_flashreg::io
