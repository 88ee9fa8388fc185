// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pcd_header.h"

#include "error.h"
#include "text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pcl_flashreg::io {
namespace {

using Words = std::vector<std::string_view>;

/** \brief The header's lines as they are written, before they are checked. */
struct Lines {
  PcdFieldLines fields;
  std::optional<std::size_t> width, height, points;
};

std::size_t
headerNumber(const Words& words, std::size_t line)
{
  std::size_t value = 0;
  if (words.size() < 2 || !parsePcdCount(words[1], value))
    throw errorAtLine(line, "expected a number after " + quoted(words[0]));
  return value;
}

/** \brief What stands there as far as it makes sense: where the sensor stood is no
 * reason to refuse a cloud. */
void
parseViewpoint(std::string_view line, PcdHeader& header)
{
  const Words words = splitWords(line, true);
  std::array<double, 7> values;
  std::size_t n = 0;
  while (n < 7 && n + 1 < words.size() && parseLeadingDouble(words[n + 1], values[n]) &&
         std::isfinite(values[n]))
    ++n;
  if (n >= 3)
    std::copy_n(values.begin(), n == 7 ? 7 : 3, header.viewpoint.begin());
  if (n < 7)
    header.notes.push_back(
        "VIEWPOINT is not seven numbers: the sensor is taken to " +
        std::string(n < 3 ? "stand at the origin" : "stand at the first three"));
}

PcdEncoding
encodingOf(std::string_view word)
{
  if (beginsWith(word, "binary_compressed"))
    return PcdEncoding::Compressed;
  if (beginsWith(word, "binary"))
    return PcdEncoding::Binary;
  return beginsWith(word, "ascii") ? PcdEncoding::Ascii : PcdEncoding::Unknown;
}

/** \brief Reads up to the DATA line. */
Lines
readLines(std::string_view bytes, PcdHeader& header)
{
  Lines lines;
  LineReader reader(bytes);
  for (std::string_view line; reader.next(line);) {
    const Words words = splitWords(line);
    if (words.empty() || words[0][0] == '#')
      continue;
    const std::string_view key = words[0];
    const Words rest(words.begin() + 1, words.end());
    // PCL looks no further than this, either.
    if (beginsWith(key, "fields") || beginsWith(key, "columns"))
      lines.fields.names = rest;
    else if (beginsWith(key, "size"))
      lines.fields.sizes = rest;
    else if (beginsWith(key, "type"))
      lines.fields.types = rest;
    else if (beginsWith(key, "count"))
      lines.fields.counts = rest;
    else if (beginsWith(key, "width"))
      lines.width = headerNumber(words, reader.lineNumber());
    else if (beginsWith(key, "height"))
      lines.height = headerNumber(words, reader.lineNumber());
    else if (beginsWith(key, "points"))
      lines.points = headerNumber(words, reader.lineNumber());
    else if (beginsWith(key, "viewpoint"))
      parseViewpoint(line, header);
    else if (beginsWith(key, "data")) {
      header.encoding = encodingOf(rest.empty() ? std::string_view() : rest[0]);
      header.body = bytes.substr(reader.position());
      header.lines = reader.lineNumber();
      return lines;
    }
    else if (!beginsWith(key, "version"))
      throw errorAtLine(reader.lineNumber(),
                        "not a PCD header: unknown keyword " + quoted(key));
  }
  throw InputError("the header has no DATA line: not a PCD file, or cut off");
}

void
setShape(const Lines& lines, PcdHeader& header)
{
  if (!lines.width && !lines.points)
    throw InputError("the header says neither WIDTH nor POINTS");
  header.width = lines.width.value_or(0);
  header.height = lines.height.value_or(1);
  if (header.height != 0 &&
      header.width > std::numeric_limits<std::size_t>::max() / header.height)
    throw InputError("WIDTH x HEIGHT is impossibly large");
  const std::size_t points = lines.points.value_or(header.width * header.height);
  // PCL's old versions wrote WIDTH 0 for points in no order.
  if (header.width * header.height == 0) {
    if (header.height == 0 || points % header.height != 0)
      header.height = 1;
    header.width = points / header.height;
  }
  if (points != header.width * header.height)
    throw InputError("POINTS is " + std::to_string(points) +
                     ", but WIDTH x HEIGHT is " +
                     std::to_string(header.width * header.height));
}

} // namespace

PcdHeader
parsePcdHeader(std::string_view bytes)
{
  // What some editors put in front.
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (beginsWith(bytes, byte_order_mark))
    bytes.remove_prefix(byte_order_mark.size());
  PcdHeader header;
  const Lines lines = readLines(bytes, header);
  header.fields = readPcdFields(lines.fields, header.body.size(), header.notes);
  setShape(lines, header);
  return header;
}

Cloud
makePcdCloud(const PcdHeader& header, std::size_t row_size, std::size_t capacity)
{
  Cloud cloud;
  cloud.viewpoint = header.viewpoint;
  cloud.notes = header.notes;
  cloud.width = header.width;
  cloud.height = header.height;
  for (const PcdField& field : header.fields)
    if (field.kept_as)
      cloud.addField(field.name, *field.kept_as, field.count);
  if (row_size == 0)
    throw InputError("the header declares no values");
  const std::size_t limit = capacity / row_size;
  if (cloud.size() > limit)
    throw InputError("is cut off: the header declares " + std::to_string(cloud.size()) +
                     " points, the body holds " + std::to_string(limit) + " at most");
  cloud.data.resize(cloud.size() * cloud.point_size);
  return cloud;
}

} // namespace pcl_flashreg::io
