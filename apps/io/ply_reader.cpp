// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "error.h"
#include "ply.h"
#include "text.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <optional>

namespace pcl_flashreg::io {
namespace {

struct Property {
  std::string name;
  ScalarType type = ScalarType::Float32;
  /** \brief Type of the list's length; none for a scalar. */
  std::optional<ScalarType> list_length;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { Ascii, LittleEndian, BigEndian };

struct Header {
  Encoding encoding = Encoding::Ascii;
  std::vector<Element> elements;
  std::size_t body = 0;
};

std::string
quoted(std::string_view text)
{
  return "'" + std::string(text.substr(0, 40)) + "'";
}

ScalarType
scalarType(std::string_view name)
{
  static const std::map<std::string_view, ScalarType> types = {
      {"char", ScalarType::Int8},
      {"int8", ScalarType::Int8},
      {"uchar", ScalarType::Uint8},
      {"uint8", ScalarType::Uint8},
      {"short", ScalarType::Int16},
      {"int16", ScalarType::Int16},
      {"ushort", ScalarType::Uint16},
      {"uint16", ScalarType::Uint16},
      {"int", ScalarType::Int32},
      {"int32", ScalarType::Int32},
      {"uint", ScalarType::Uint32},
      {"uint32", ScalarType::Uint32},
      {"float", ScalarType::Float32},
      {"float32", ScalarType::Float32},
      {"double", ScalarType::Float64},
      {"float64", ScalarType::Float64}};
  const auto it = types.find(name);
  if (it == types.end())
    throw InputError("a property has the unknown type " + quoted(name));
  return it->second;
}

Encoding
encodingOf(const std::vector<std::string_view>& words)
{
  if (words.size() >= 2) {
    if (words[1] == "ascii")
      return Encoding::Ascii;
    if (words[1] == "binary_little_endian")
      return Encoding::LittleEndian;
    if (words[1] == "binary_big_endian")
      return Encoding::BigEndian;
  }
  throw InputError("the format line says neither ascii, binary_little_endian nor "
                   "binary_big_endian");
}

Property
propertyOf(const std::vector<std::string_view>& words)
{
  if (words.size() == 3)
    return {std::string(words[2]), scalarType(words[1]), std::nullopt};
  if (words.size() == 5 && words[1] == "list") {
    const ScalarType length = scalarType(words[2]);
    if (!isFloat(length))
      return {std::string(words[4]), scalarType(words[3]), length};
  }
  throw InputError("the header has a property line that makes no sense");
}

Header
parseHeader(std::string_view bytes)
{
  Header header;
  LineReader lines(bytes);
  std::string_view line;
  if (!lines.next(line) || splitWords(line) != std::vector<std::string_view>{"ply"})
    throw InputError("does not begin with 'ply': not a PLY file");
  bool has_format = false;
  while (lines.next(line)) {
    const auto words = splitWords(line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info")
      continue;
    if (words[0] == "end_header") {
      if (!has_format)
        throw InputError("the header has no format line");
      header.body = lines.position();
      return header;
    }
    if (words[0] == "format") {
      header.encoding = encodingOf(words);
      has_format = true;
    }
    else if (words[0] == "element") {
      Element element;
      if (words.size() != 3 || !parseUnsigned(words[2], element.count))
        throw InputError("the header has an element line that makes no sense");
      element.name = std::string(words[1]);
      header.elements.push_back(element);
    }
    else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(propertyOf(words));
    }
    else {
      throw InputError("line " + std::to_string(lines.lineNumber()) +
                       ": not a PLY header: unknown keyword " + quoted(words[0]));
    }
  }
  throw InputError("the header has no end_header line: cut off");
}

[[noreturn]] void
failCutOff()
{
  throw InputError("is cut off: the body is shorter than the header declares");
}

/** \brief Hands out the values of a text body, whatever the line ends. */
class AsciiBody {
public:
  explicit AsciiBody(std::string_view text) : text_(text) {}

  static std::size_t
  minimumSize(ScalarType)
  {
    return 2;
  }

  void
  read(std::uint8_t* point, const Field& field)
  {
    const std::string_view word = take();
    if (!storeWord(word, point, field, 0))
      throw InputError(quoted(word) + " is no value for the property " +
                       quoted(field.name));
  }

private:
  std::string_view
  take()
  {
    const auto blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    while (!text_.empty() && blank(text_.front()))
      text_.remove_prefix(1);
    const auto end = std::find_if(text_.begin(), text_.end(), blank);
    if (text_.empty())
      failCutOff();
    const std::string_view word = text_.substr(0, end - text_.begin());
    text_.remove_prefix(word.size());
    return word;
  }

  std::string_view text_;
};

/** \brief Hands out the values of a binary body in the byte order of this machine,
 * which is taken to be little endian, as PCL's PCD files take it. */
class BinaryBody {
public:
  BinaryBody(std::string_view bytes, bool swap) : bytes_(bytes), swap_(swap) {}

  static std::size_t
  minimumSize(ScalarType type)
  {
    return sizeOf(type);
  }

  void
  read(std::uint8_t* point, const Field& field)
  {
    const std::size_t size = sizeOf(field.type);
    if (bytes_.size() < size)
      failCutOff();
    std::uint8_t* to = point + field.offset;
    std::memcpy(to, bytes_.data(), size);
    if (swap_)
      std::reverse(to, to + size);
    bytes_.remove_prefix(size);
  }

private:
  std::string_view bytes_;
  bool swap_;
};

template <typename Body>
void
skipList(Body& body, const Property& property)
{
  std::uint8_t value[8];
  const Field length_field{property.name, *property.list_length, 1, 0};
  body.read(value, length_field);
  const double length = loadValue(value, length_field);
  if (length < 0)
    throw InputError("the list " + quoted(property.name) + " has a negative length");
  const Field item{property.name, property.type, 1, 0};
  for (double k = 0; k < length; ++k)
    body.read(value, item);
}

/** \brief Reads one row; fields is null for an element that is not kept. */
template <typename Body>
void
readRow(Body& body,
        const Element& element,
        const std::vector<Field>* fields,
        std::uint8_t* row)
{
  std::size_t kept = 0;
  for (const Property& property : element.properties) {
    if (property.list_length) {
      skipList(body, property);
      continue;
    }
    std::uint8_t unused[8];
    if (fields != nullptr)
      body.read(row, (*fields)[kept++]);
    else
      body.read(unused, {property.name, property.type, 1, 0});
  }
}

template <typename Body>
Cloud
readVertices(Body& body, const Element& element, std::size_t body_size)
{
  Cloud cloud;
  std::size_t minimum = 0;
  for (const Property& property : element.properties) {
    minimum += Body::minimumSize(property.list_length.value_or(property.type));
    if (!property.list_length)
      cloud.addField(property.name, property.type);
  }
  // The last value of a text may lack a blank after it: one byte more than there is.
  if (minimum == 0)
    throw InputError("the vertices have no properties");
  if (element.count > (body_size + 1) / minimum)
    failCutOff();
  cloud.width = element.count;
  cloud.data.resize(cloud.size() * cloud.point_size);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    readRow(body, element, &cloud.fields, cloud.point(i));
  return cloud;
}

/** \brief Steps over the elements before the vertices; those after them are not looked
 * at. */
template <typename Body>
Cloud
readBody(Body body, const Header& header, std::size_t body_size)
{
  for (const Element& element : header.elements) {
    if (element.name == "vertex")
      return readVertices(body, element, body_size);
    if (!element.properties.empty())
      for (std::size_t i = 0; i < element.count; ++i)
        readRow(body, element, nullptr, nullptr);
  }
  throw InputError("the header declares no vertices");
}

} // namespace

Cloud
parsePly(std::string_view bytes)
{
  const Header header = parseHeader(bytes);
  const std::string_view body = bytes.substr(header.body);
  if (header.encoding == Encoding::Ascii)
    return toPclFields(readBody(AsciiBody(body), header, body.size()));
  const bool swap = header.encoding == Encoding::BigEndian;
  return toPclFields(readBody(BinaryBody(body, swap), header, body.size()));
}

} // namespace pcl_flashreg::io
