// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "error.h"
#include "ply.h"
#include "ply_body.h"
#include "ply_camera.h"
#include "ply_header.h"
#include "text.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace pcl_flashreg::io {
namespace {

std::string
quoted(std::string_view word)
{
  return "'" + std::string(word.substr(0, 40)) + "'";
}

template <typename Body>
void
skipList(Body& body, const PlyProperty& property)
{
  const double length = body.listLength(property);
  for (double k = 0; k < length; ++k)
    body.skip(property.type);
}

bool
isCoordinate(const PlyElement& element, const std::string& name)
{
  return element.name == "vertex" && (name == "x" || name == "y" || name == "z");
}

void
checkReadable(const PlyElement& element)
{
  if (!element.fault.empty())
    throw InputError(element.fault);
}

template <typename Body>
void
skipRows(Body& body, const PlyElement& element)
{
  checkReadable(element);
  if (element.properties.empty())
    return;
  for (std::size_t i = 0; i < element.count; ++i)
    for (const PlyProperty& property : element.properties)
      if (property.list_length)
        skipList(body, property);
      else
        body.skip(property.type);
}

/** \brief Names of the fields that the scalar properties become, all different. X, Y and
 * Z are the coordinates where there is no x, y or z. */
std::vector<std::string>
fieldNames(const PlyElement& element)
{
  std::map<std::string, std::size_t> copies;
  for (const PlyProperty& property : element.properties)
    copies[property.name] = 1;
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (const PlyProperty& property : element.properties) {
    if (property.list_length)
      continue;
    std::string name = property.name;
    if (name == "X" || name == "Y" || name == "Z") {
      const std::string small(1, static_cast<char>(name[0] - 'X' + 'x'));
      name = copies.count(small) == 0 ? small : name;
    }
    if (!taken.insert(name).second && !isCoordinate(element, name)) {
      std::size_t& number = copies[name];
      do
        name = property.name + "_" + std::to_string(++number);
      while (copies.count(name) != 0 || !taken.insert(name).second);
    }
    names.push_back(name);
  }
  return names;
}

/** \brief What becomes of words in a text that are no values for their fields: a number
 * makes the field one of doubles, anything else costs the field. Coordinates must be
 * right. */
class OddWords {
public:
  explicit OddWords(const PlyElement& element) : element_(element) {}

  void
  add(std::string_view word, std::size_t field, std::size_t row, Cloud& cloud)
  {
    const std::string name = cloud.fields[field].name;
    const std::string what =
        quoted(word) + " is no value for the property " + quoted(name);
    double value = std::numeric_limits<double>::quiet_NaN();
    const bool number = parseDouble(word, value);
    if (isCoordinate(element_, name))
      throw InputError(what);
    if (number && lost_.count(name) == 0)
      becomeDoubles(field, cloud);
    else if (!number && lost_.insert(name).second)
      notes_.push_back(what + ": it is left out");
    storeValue(cloud.point(row), cloud.fields[field], value);
  }

  void
  settle(Cloud& cloud) const
  {
    std::vector<Field> kept;
    for (const Field& field : cloud.fields)
      if (lost_.count(field.name) == 0)
        kept.push_back(field);
    if (kept.size() < cloud.fields.size())
      cloud = withFields(cloud, kept);
    cloud.notes.insert(cloud.notes.end(), notes_.begin(), notes_.end());
  }

private:
  static void
  becomeDoubles(std::size_t field, Cloud& cloud)
  {
    std::vector<Field> fields = cloud.fields;
    fields[field].type = ScalarType::Float64;
    cloud = withFields(cloud, fields);
  }

  const PlyElement& element_;
  std::set<std::string> lost_;
  std::vector<std::string> notes_;
};

/** \brief A cloud with a field for each scalar property, and memory for its rows. */
template <typename Body>
Cloud
layoutOf(const Body& body, const PlyElement& element)
{
  Cloud cloud;
  const std::vector<std::string> names = fieldNames(element);
  std::size_t minimum = 0;
  for (const PlyProperty& property : element.properties) {
    minimum += Body::minimumSize(property.list_length.value_or(property.type));
    if (!property.list_length)
      cloud.addField(names[cloud.fields.size()], property.type);
  }
  if (minimum == 0)
    throw InputError("the element " + quoted(element.name) + " has no properties");
  if (element.count > body.size() / minimum)
    failCutOff();
  cloud.width = element.count;
  cloud.data.resize(cloud.size() * cloud.point_size);
  return cloud;
}

/** \brief Reads the scalar properties of all rows of an element. */
template <typename Body>
Cloud
readRows(Body& body, const PlyElement& element)
{
  checkReadable(element);
  Cloud cloud = layoutOf(body, element);
  OddWords odd(element);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    std::size_t k = 0;
    for (const PlyProperty& property : element.properties) {
      if (property.list_length) {
        skipList(body, property);
        continue;
      }
      const std::string_view word = body.read(cloud.point(i), cloud.fields[k]);
      if (!word.empty())
        odd.add(word, k, i, cloud);
      ++k;
    }
  }
  odd.settle(cloud);
  return cloud;
}

bool
isCamera(const PlyElement& element)
{
  return element.name == "camera";
}

/** \brief Reads the vertices, and the camera wherever it is. What is wrong behind the
 * vertices costs no more than the camera. */
template <typename Body>
Cloud
readBody(Body body, const PlyHeader& header)
{
  const auto begin = header.elements.begin(), end = header.elements.end();
  const auto vertices = std::find_if(
      begin, end, [](const PlyElement& element) { return element.name == "vertex"; });
  if (vertices == end)
    throw InputError("the header declares no vertices");
  Cloud cameras;
  const auto step = [&](const PlyElement& element) {
    if (isCamera(element) && element.count > 0 && element.fault.empty() &&
        !element.properties.empty())
      cameras = readRows(body, element);
    else
      skipRows(body, element);
  };
  std::for_each(begin, vertices, step);
  Cloud cloud = readRows(body, *vertices);
  if (header.origin)
    std::copy(header.origin->begin(), header.origin->end(), cloud.viewpoint.begin());
  const auto camera = std::find_if(vertices, end, isCamera);
  try {
    if (camera != end)
      std::for_each(vertices + 1, camera + 1, step);
  }
  catch (const InputError& error) {
    cloud.notes.push_back("the sensor's pose behind its points cannot be read: " +
                          std::string(error.what()));
  }
  takeCamera(cameras, cloud);
  return cloud;
}

} // namespace

Cloud
parsePly(std::string_view bytes)
{
  const PlyHeader header = parsePlyHeader(bytes);
  const std::string_view body = bytes.substr(header.size);
  if (header.encoding == PlyEncoding::Ascii)
    return toPclFields(readBody(AsciiBody(body), header));
  const bool swap = header.encoding == PlyEncoding::BigEndian;
  return toPclFields(readBody(BinaryBody(body, swap), header));
}

} // namespace pcl_flashreg::io
