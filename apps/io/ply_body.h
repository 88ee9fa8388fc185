// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "error.h"
#include "ply_header.h"
#include "text.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

namespace pcl_flashreg::io {

[[noreturn]] inline void
failCutOff()
{
  throw InputError("is cut off: the body is shorter than the header declares");
}

/** \brief Hands out the values of a text body, whatever the line ends. */
class AsciiBody {
public:
  explicit AsciiBody(std::string_view text) : text_(text) {}

  /** \brief The least that a value takes, a blank behind it included. */
  static std::size_t
  minimumSize(ScalarType)
  {
    return 2;
  }

  /** \brief Bytes left; the last value may lack its blank. */
  std::size_t
  size() const
  {
    return text_.size() + 1;
  }

  void
  skip(ScalarType)
  {
    take();
  }

  /** \brief A negative length, as of a list that isn't there, is 0. */
  double
  listLength(const PlyProperty& property)
  {
    const std::string_view word = take();
    double length = 0;
    if (!parseDouble(word, length) || length != std::floor(length))
      throw InputError("a length of the list '" + property.name + "' is no number");
    return length;
  }

  /** \brief Stores a value.
   * \return the word if it is no value for the field */
  std::string_view
  read(std::uint8_t* point, const Field& field)
  {
    const std::string_view word = take();
    return storeWord(word, point, field, 0) ? std::string_view() : word;
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

  std::size_t
  size() const
  {
    return bytes_.size();
  }

  void
  skip(ScalarType type)
  {
    if (bytes_.size() < sizeOf(type))
      failCutOff();
    bytes_.remove_prefix(sizeOf(type));
  }

  double
  listLength(const PlyProperty& property)
  {
    std::uint8_t value[8];
    const Field field{property.name, *property.list_length, 1, 0};
    read(value, field);
    const double length = loadValue(value, field);
    if (length < 0)
      throw InputError("the list '" + property.name + "' has a negative length");
    return length;
  }

  std::string_view
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
    return {};
  }

private:
  std::string_view bytes_;
  bool swap_;
};

} // namespace pcl_flashreg::io
