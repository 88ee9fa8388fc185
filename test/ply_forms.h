// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// PLY files that are put together from parts, so that tests can change each of them.

#include "cloud_io_support.h"

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace pcl_flashreg::io::forms {

enum class Encoding { Ascii, LittleEndian, BigEndian };

constexpr std::array<Encoding, 3> ENCODINGS = {
    Encoding::Ascii, Encoding::LittleEndian, Encoding::BigEndian};

inline const char*
nameOf(Encoding encoding)
{
  return encoding == Encoding::Ascii          ? "ascii"
         : encoding == Encoding::LittleEndian ? "binary_little_endian"
                                              : "binary_big_endian";
}

/** \brief A property: what stands behind the word "property", and its values. */
struct Column {
  /** \brief "float x", "list uchar int i". */
  std::string declaration;
  /** \brief Value of a row, of its column k. */
  double (*value)(std::size_t row);
  /** \brief Values in a list. */
  std::size_t length = 2;
  /** \brief In an ascii file, words instead of the numbers, row by row. */
  std::vector<std::string> words;
};

struct Element {
  std::string name;
  std::size_t rows = 0;
  std::vector<Column> columns;
  /** \brief Behind the count. */
  std::string tail;
};

/** \brief A point of every form: no two rows, and no two axes, are alike. */
inline double
coordinate(std::size_t row, std::size_t axis)
{
  return 0.25 * static_cast<double>(row) - static_cast<double>(axis) - 0.5;
}

struct Form {
  static constexpr std::size_t POINTS = 7;

  std::string magic = "ply";
  std::string line_end = "\n";
  std::string format_tail = " 1.0";
  /** \brief Lines behind the format, and before the end of the header. */
  std::vector<std::string> first_lines, last_lines;
  std::vector<Element> elements = {
      {"vertex",
       POINTS,
       {{"float x", [](std::size_t row) { return coordinate(row, 0); }, 2, {}},
        {"float y", [](std::size_t row) { return coordinate(row, 1); }, 2, {}},
        {"float z", [](std::size_t row) { return coordinate(row, 2); }, 2, {}}},
       ""}};
  /** \brief Between the values of an ascii row, before them and behind. */
  std::string blank = " ", indent, row_tail;
  /** \brief Behind the body. */
  std::string rest;

  Element&
  vertex()
  {
    for (Element& element : elements)
      if (element.name == "vertex")
        return element;
    throw std::logic_error("no vertices");
  }

  std::string
  bytes(Encoding encoding) const
  {
    std::string text = magic + line_end + "format " + nameOf(encoding) + format_tail;
    text += line_end;
    for (const std::string& line : first_lines)
      text += line + line_end;
    for (const Element& element : elements) {
      text += "element " + element.name + ' ' + std::to_string(element.rows) +
              element.tail + line_end;
      for (const Column& column : element.columns)
        text += "property " + column.declaration + line_end;
    }
    for (const std::string& line : last_lines)
      text += line + line_end;
    text += "end_header" + line_end;
    for (const Element& element : elements)
      for (std::size_t row = 0; row < element.rows; ++row)
        text += encoding == Encoding::Ascii
                    ? asciiRow(element, row)
                    : binaryRow(element, row, encoding == Encoding::BigEndian);
    return text + rest;
  }

private:
  std::string
  asciiRow(const Element& element, std::size_t row) const
  {
    std::string text = indent;
    const auto add = [&](const std::string& word) {
      text += (text == indent ? "" : blank) + word;
    };
    for (const Column& column : element.columns) {
      if (row < column.words.size()) {
        add(column.words[row]);
        continue;
      }
      const bool list = column.declaration.substr(0, 5) == "list ";
      if (list)
        add(std::to_string(column.length));
      for (std::size_t k = 0; k < (list ? column.length : 1); ++k) {
        std::ostringstream word;
        word << column.value(row);
        add(word.str());
      }
    }
    return text + row_tail + line_end;
  }

  static std::string
  binaryRow(const Element& element, std::size_t row, bool big)
  {
    std::string raw;
    for (const Column& column : element.columns) {
      std::istringstream words(column.declaration);
      std::string type;
      words >> type;
      std::size_t number = 1;
      if (type == "list") {
        words >> type;
        number = column.length;
        appendAs(raw, type, static_cast<double>(number), big);
        words >> type;
      }
      for (std::size_t k = 0; k < number; ++k)
        appendAs(raw, type, column.value(row), big);
    }
    return raw;
  }

  static void
  appendAs(std::string& raw, const std::string& type, double value, bool big)
  {
    if (type == "char" || type == "int8")
      append(raw, static_cast<std::int8_t>(value), big);
    else if (type == "uchar" || type == "uint8")
      append(raw, static_cast<std::uint8_t>(value), big);
    else if (type == "short" || type == "int16")
      append(raw, static_cast<std::int16_t>(value), big);
    else if (type == "ushort" || type == "uint16")
      append(raw, static_cast<std::uint16_t>(value), big);
    else if (type == "int" || type == "int32")
      append(raw, static_cast<std::int32_t>(value), big);
    else if (type == "uint" || type == "uint32")
      append(raw, static_cast<std::uint32_t>(value), big);
    else if (type == "float" || type == "float32")
      append(raw, static_cast<float>(value), big);
    else if (type == "double" || type == "float64")
      append(raw, value, big);
    else
      append(raw, static_cast<std::int64_t>(value), big);
  }
};

} // namespace pcl_flashreg::io::forms
