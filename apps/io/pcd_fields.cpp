// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pcd_fields.h"

#include "error.h"
#include "text.h"

#include <algorithm>
#include <map>
#include <utility>

namespace pcl_flashreg::io {
namespace {

using Words = std::vector<std::string_view>;
using Notes = std::vector<std::string>;

/** \brief Half floats are kept as float32, and truth values as bytes. */
std::optional<ScalarType>
scalarType(std::string_view type, std::size_t size)
{
  if (beginsWith(type, "f")) {
    if (size == 2 || size == 4)
      return ScalarType::Float32;
    if (size == 8)
      return ScalarType::Float64;
  }
  const bool is_signed = beginsWith(type, "i");
  if (is_signed || beginsWith(type, "u")) {
    if (size == 1)
      return is_signed ? ScalarType::Int8 : ScalarType::Uint8;
    if (size == 2)
      return is_signed ? ScalarType::Int16 : ScalarType::Uint16;
    if (size == 4)
      return is_signed ? ScalarType::Int32 : ScalarType::Uint32;
    if (size == 8)
      return is_signed ? ScalarType::Int64 : ScalarType::Uint64;
  }
  if (beginsWith(type, "b") && size == 1)
    return ScalarType::Uint8;
  return std::nullopt;
}

// What PCL takes where the lines are missing.
constexpr const char* DEFAULT_SIZE = "4";
constexpr const char* DEFAULT_TYPE = "F";

/** \brief The entry of a field on one of the lines SIZE, TYPE and COUNT. */
std::string_view
entryOf(const Words& words, std::size_t field, std::string_view default_word)
{
  return words.empty() ? default_word : words[field];
}

bool
isKept(const std::vector<PcdField>& fields, const std::string& name)
{
  return std::any_of(fields.begin(), fields.end(), [&](const PcdField& field) {
    return field.kept_as && field.name == name;
  });
}

/** \brief X, Y and Z are coordinates where nothing else is. */
void
takeCapitals(std::vector<PcdField>& fields, Notes& notes)
{
  std::string taken;
  for (const char* const name : {"x", "y", "z"}) {
    const std::string capital(1, static_cast<char>(name[0] - 'a' + 'A'));
    if (isKept(fields, name) || !isKept(fields, capital))
      continue;
    for (PcdField& field : fields)
      if (field.name == capital)
        field.name = name;
    taken += " " + quoted(capital);
  }
  if (!taken.empty())
    notes.push_back("fields are taken for coordinates:" + taken);
}

/** \brief Gives fields that have one name different ones. */
void
renameDuplicates(std::vector<PcdField>& fields, Notes& notes)
{
  struct Name {
    const PcdField* owner = nullptr;
    std::size_t copies = 1;
  };
  // Coordinates are those that PCL takes: the first of the type that it knows for them.
  const auto suitsPcl = [](const PcdField& field) {
    return !isCoordinate(field.name) || (field.kept_as == ScalarType::Float32 &&
                                         field.value_size == 4 && field.count == 1);
  };
  std::map<std::string, Name> names;
  for (const PcdField& field : fields) {
    if (!field.kept_as)
      continue;
    const PcdField*& owner = names[field.name].owner;
    if (owner == nullptr || (!suitsPcl(*owner) && suitsPcl(field)))
      owner = &field;
  }
  for (PcdField& field : fields) {
    if (!field.kept_as || names[field.name].owner == &field)
      continue;
    std::string name;
    do
      name = field.name + "_" + std::to_string(++names[field.name].copies);
    while (names.count(name) != 0);
    notes.push_back("there is more than one field " + quoted(field.name) +
                    ": another one is named " + quoted(name));
    field.name = name;
    names[name].owner = &field;
  }
}

/** \brief What the header says of one field.
 * \param[in] room bytes that a point can have for it
 */
PcdField
fieldOf(const PcdFieldLines& lines, std::size_t i, std::size_t room)
{
  const std::string_view size = entryOf(lines.sizes, i, DEFAULT_SIZE);
  const std::string_view count = entryOf(lines.counts, i, "1");
  PcdField field;
  field.name = std::string(lines.names[i]);
  if (!parsePcdCount(size, field.value_size))
    field.value_size = 0;
  if (!parsePcdCount(count, field.count) ||
      field.count > room / std::max<std::size_t>(field.value_size, 1))
    throw InputError("the field " + quoted(field.name) + " has the impossible COUNT " +
                     quoted(count) + " with SIZE " + quoted(size));
  if (field.name != "_")
    field.kept_as = scalarType(entryOf(lines.types, i, DEFAULT_TYPE), field.value_size);
  return field;
}

} // namespace

bool
parsePcdCount(std::string_view word, std::size_t& count)
{
  double value = 0;
  if (!parseLeadingDouble(word, value) || !(value >= 0 && value < 0x1p63))
    return false;
  count = static_cast<std::size_t>(value);
  return true;
}

bool
isCoordinate(const std::string& name)
{
  return name == "x" || name == "y" || name == "z";
}

std::vector<PcdField>
readPcdFields(const PcdFieldLines& lines,
              std::size_t body_size,
              std::vector<std::string>& notes)
{
  const std::size_t n = lines.names.size();
  if (n == 0)
    throw InputError("the header has no FIELDS line");
  for (const Words* words : {&lines.sizes, &lines.types, &lines.counts})
    if (!words->empty() && words->size() != n)
      throw InputError(
          "FIELDS, SIZE, TYPE and COUNT do not have the same number of entries");
  std::vector<PcdField> fields;
  std::vector<std::pair<std::string, std::string>> unknown;
  // One value takes a byte of the file at least (in ascii, in binary, and in LZF one
  // byte in 88), which bounds what a point can have.
  std::size_t room = 100 * (body_size + 100);
  for (std::size_t i = 0; i < n; ++i) {
    const PcdField field = fieldOf(lines, i, room);
    if (field.count == 0)
      continue;
    room -= std::max(field.byteSize(), field.count);
    if (!field.kept_as && field.name != "_")
      unknown.emplace_back(
          field.name,
          "the field " + quoted(field.name) + " has the unknown TYPE " +
              quoted(entryOf(lines.types, i, DEFAULT_TYPE)) + " with SIZE " +
              quoted(entryOf(lines.sizes, i, DEFAULT_SIZE)));
    fields.push_back(field);
  }
  takeCapitals(fields, notes);
  renameDuplicates(fields, notes);
  for (const auto& [name, message] : unknown) {
    if (isCoordinate(name) && !isKept(fields, name))
      throw InputError(message);
    notes.push_back(message + ": it is left out");
  }
  return fields;
}

} // namespace pcl_flashreg::io
