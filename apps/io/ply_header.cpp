// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "ply_header.h"

#include "error.h"
#include "text.h"

#include <map>

namespace pcl_flashreg::io {
namespace {

using Words = std::vector<std::string_view>;

std::string
quoted(std::string_view word)
{
  return "'" + std::string(word.substr(0, 40)) + "'";
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
      {"int64", ScalarType::Int64},
      {"uint64", ScalarType::Uint64},
      {"float", ScalarType::Float32},
      {"float32", ScalarType::Float32},
      {"double", ScalarType::Float64},
      {"float64", ScalarType::Float64}};
  const auto it = types.find(name);
  if (it == types.end())
    throw InputError("a property has the unknown type " + quoted(name));
  return it->second;
}

PlyEncoding
encodingOf(const Words& words)
{
  if (words.size() >= 2) {
    if (words[1] == "ascii")
      return PlyEncoding::Ascii;
    if (words[1] == "binary_little_endian")
      return PlyEncoding::LittleEndian;
    if (words[1] == "binary_big_endian")
      return PlyEncoding::BigEndian;
  }
  throw InputError("the format line says neither ascii, binary_little_endian nor "
                   "binary_big_endian");
}

PlyElement
elementOf(const Words& words)
{
  PlyElement element;
  if (words.size() > 1)
    element.name = std::string(words[1]);
  if (words.size() != 3 || !parseUnsigned(words[2], element.count))
    element.fault = "the header has an element line that makes no sense";
  return element;
}

/** \brief PCL reads no further than to the name, so neither do we. */
PlyProperty
propertyOf(const Words& words)
{
  if (words.size() >= 5 && words[1] == "list") {
    const ScalarType length = scalarType(words[2]);
    if (!isFloat(length))
      return {std::string(words[4]), scalarType(words[3]), length};
  }
  else if (words.size() >= 3 && words[1] != "list") {
    return {std::string(words[2]), scalarType(words[1]), std::nullopt};
  }
  throw InputError("the header has a property line that makes no sense");
}

void
addProperty(const Words& words, PlyElement& element)
{
  try {
    element.properties.push_back(propertyOf(words));
  }
  catch (const InputError& error) {
    if (element.fault.empty())
      element.fault = error.what();
  }
}

/** \brief The three offsets by which PCL's writer states the sensor's origin. Other
 * programs, whose offsets they were at first, mean the place of a colour camera. */
class Offsets {
public:
  void
  read(const Words& words)
  {
    if (words == Words{"comment", "PCL", "generated"})
      by_pcl_ = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (words.size() == 3 && words[0] == "obj_info" && words[1] == kNames[axis])
        known_[axis] = parseDouble(words[2], values_[axis]);
  }

  std::optional<std::array<double, 3>>
  get() const
  {
    if (by_pcl_ && known_[0] && known_[1] && known_[2])
      return values_;
    return std::nullopt;
  }

private:
  static constexpr std::string_view kNames[] = {
      "echo_rgb_offset_x", "echo_rgb_offset_y", "echo_rgb_offset_z"};

  std::array<double, 3> values_{};
  std::array<bool, 3> known_{};
  bool by_pcl_ = false;
};

} // namespace

PlyHeader
parsePlyHeader(std::string_view bytes)
{
  constexpr std::string_view magic = "ply";
  if (bytes.substr(0, magic.size()) != magic)
    throw InputError("does not begin with 'ply': not a PLY file");
  PlyHeader header;
  Offsets offsets;
  bool has_format = false;
  LineReader lines(bytes.substr(magic.size()));
  for (std::string_view line; lines.next(line);) {
    const Words words = splitWords(line);
    const std::string_view key = words.empty() ? std::string_view() : words[0];
    if (key == "end_header") {
      if (!has_format)
        throw InputError("the header has no format line");
      header.size = magic.size() + lines.position();
      header.origin = offsets.get();
      return header;
    }
    if (key == "format") {
      header.encoding = encodingOf(words);
      has_format = true;
    }
    else if (key == "element")
      header.elements.push_back(elementOf(words));
    else if (key == "property" && header.elements.empty())
      throw InputError("the header has a property before any element");
    else if (key == "property")
      addProperty(words, header.elements.back());
    else
      offsets.read(words);
  }
  throw InputError("the header has no end_header line: cut off");
}

} // namespace pcl_flashreg::io
