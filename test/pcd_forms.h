// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// PCD files in every form that programs write.

#include "cloud_io_support.h"
#include "io/lzf.h"

#include <array>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace pcl_flashreg::io::forms {

enum class Encoding { Ascii, Binary, Compressed };

constexpr Encoding ENCODINGS[] = {
    Encoding::Ascii, Encoding::Binary, Encoding::Compressed};

inline const char*
nameOf(Encoding encoding)
{
  return encoding == Encoding::Ascii    ? "ascii"
         : encoding == Encoding::Binary ? "binary"
                                        : "binary_compressed";
}

/** \brief A field of a file. */
struct Column {
  std::string name;
  char type = 'F';
  std::size_t size = 4;
  std::size_t count = 1;
  /** \brief The field's name in a cloud; empty if it is left out. */
  std::string kept_as = name;

  bool
  is(const char* types, std::size_t bytes) const
  {
    return std::strchr(types, type) != nullptr && size == bytes;
  }
};

/** \brief A file of a few points whose header and body can be changed in one place and
 * stay right everywhere else. */
struct Form {
  struct Line {
    std::string key;
    std::string words;
  };

  std::vector<Column> columns;
  std::vector<Line> lines;
  std::size_t width = 6;
  std::size_t height = 1;
  std::array<double, 7> viewpoint = {1, 2, 3, 0.5, -0.5, 0.5, -0.5};
  bool pcl_keeps_viewpoint = true;
  std::string top = "# .PCD v.7 - Point Cloud Data file format\n";
  std::string separator = " ";
  std::string before_line, after_line;
  std::string line_end = "\n";
  std::string between_header_lines, between_points;
  std::string value_separator = " ";
  /** \brief "*" stands for the name of the encoding. */
  std::string data = "*";
  bool capital_encoding = false;
  /** \brief In ascii, what stands for the values of one column, point by point. */
  std::vector<std::string> odd_words;
  std::size_t odd_column = 0;

  Form()
  {
    lines = {{"VERSION", ".7"},
             {"FIELDS", ""},
             {"SIZE", ""},
             {"TYPE", ""},
             {"COUNT", ""},
             {"WIDTH", "6"},
             {"HEIGHT", "1"},
             {"VIEWPOINT", "1 2 3 0.5 -0.5 0.5 -0.5"},
             {"POINTS", "6"}};
    setColumns({{"x"}, {"y"}, {"z"}, {"i", 'U', 1}});
  }

  std::size_t
  size() const
  {
    return width * height;
  }

  std::size_t
  indexOf(const std::string& key) const
  {
    std::size_t index = 0;
    while (index < lines.size() && lines[index].key != key)
      ++index;
    return index;
  }

  /** \brief Appends the line if there is none yet. */
  void
  set(const std::string& key, const std::string& words)
  {
    const std::size_t index = indexOf(key);
    if (index == lines.size())
      lines.push_back({key, words});
    else
      lines[index].words = words;
  }

  void
  remove(const std::string& key)
  {
    const std::size_t index = indexOf(key);
    if (index < lines.size())
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(index));
  }

  /** \brief Puts the line where the one with the second key is. */
  void
  move(const std::string& key, const std::string& to)
  {
    const std::size_t index = indexOf(key);
    if (index == lines.size() || indexOf(to) == lines.size())
      return;
    const Line line = lines[index];
    const std::size_t at = indexOf(to);
    remove(key);
    lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), line);
  }

  void
  setColumns(const std::vector<Column>& value)
  {
    columns = value;
    std::string names, sizes, types, counts;
    for (const Column& column : columns) {
      names += " " + column.name;
      sizes += " " + std::to_string(column.size);
      types += std::string(" ") + column.type;
      counts += " " + std::to_string(column.count);
    }
    set("FIELDS", names.substr(1));
    set("SIZE", sizes.substr(1));
    set("TYPE", types.substr(1));
    set("COUNT", counts.substr(1));
  }

  /** \brief What every encoding and every type that is meant for it can hold. */
  double
  value(std::size_t i, std::size_t column, std::size_t k = 0) const
  {
    const auto v = static_cast<double>((i * 7 + column * 3 + k * 5) % 50);
    switch (columns[column].type) {
    case 'F':
      return 0.25 * v - 2;
    case 'I':
      return v - 20;
    case 'B':
      return std::fmod(v, 2);
    default:
      return v;
    }
  }

  double
  coordinate(std::size_t i, int axis) const
  {
    const std::string name(1, static_cast<char>('x' + axis));
    std::size_t column = 0;
    while (columns[column].kept_as != name)
      ++column;
    return value(i, column);
  }

  std::string
  bytes(Encoding encoding) const
  {
    std::string name = nameOf(encoding);
    if (capital_encoding)
      name[0] = static_cast<char>(name[0] - 'a' + 'A');
    std::string words = data;
    words.replace(words.find('*'), 1, name);
    std::string text = top;
    for (const Line& line : lines)
      text += lineText(line) + between_header_lines;
    text += lineText({"DATA", words});
    if (encoding == Encoding::Ascii)
      return text + asciiBody();
    return text + (encoding == Encoding::Binary ? binaryBody() : compressedBody());
  }

private:
  std::string
  lineText(const Line& line) const
  {
    std::string words;
    for (const char c : line.words)
      words += c == ' ' ? separator : std::string(1, c);
    return before_line + line.key + separator + words + after_line + line_end;
  }

  std::string
  asciiBody() const
  {
    std::ostringstream text;
    for (std::size_t i = 0; i < size(); ++i) {
      std::string before = before_line;
      for (std::size_t c = 0; c < columns.size(); ++c)
        for (std::size_t k = 0; k < columns[c].count; ++k) {
          text << before;
          if (c == odd_column && i < odd_words.size())
            text << odd_words[i];
          else
            text << value(i, c, k);
          before = value_separator;
        }
      text << after_line << line_end << between_points;
    }
    return text.str();
  }

  void
  appendBinary(std::string& to, std::size_t i, std::size_t c, std::size_t k) const
  {
    const Column& column = columns[c];
    const double v = value(i, c, k);
    if (column.is("Ff", 4))
      append(to, static_cast<float>(v));
    else if (column.is("Ff", 8))
      append(to, v);
    else if (column.is("Ff", 2))
      append(to, halfOf(v));
    else {
      std::string integer;
      append(integer, static_cast<std::int64_t>(v));
      integer.resize(column.size, '\0');
      to += integer;
    }
  }

  /** \brief The half float of a number that is one, neither tiny nor huge. */
  static std::uint16_t
  halfOf(double value)
  {
    if (value == 0)
      return 0;
    int exponent = 0;
    const double fraction = std::frexp(std::abs(value), &exponent);
    const auto mantissa = static_cast<unsigned>(fraction * 2048) - 1024;
    return static_cast<std::uint16_t>((value < 0 ? 0x8000u : 0u) |
                                      static_cast<unsigned>(exponent + 14) << 10 |
                                      mantissa);
  }

  std::string
  binaryBody() const
  {
    std::string body;
    for (std::size_t i = 0; i < size(); ++i)
      for (std::size_t c = 0; c < columns.size(); ++c)
        for (std::size_t k = 0; k < columns[c].count; ++k)
          appendBinary(body, i, c, k);
    return body;
  }

  std::string
  compressedBody() const
  {
    std::string plain;
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t i = 0; i < size(); ++i)
        for (std::size_t k = 0; k < columns[c].count; ++k)
          appendBinary(plain, i, c, k);
    const auto packed = compressLzf({plain.begin(), plain.end()});
    std::string body;
    append(body, static_cast<std::uint32_t>(packed.size()));
    append(body, static_cast<std::uint32_t>(plain.size()));
    return body.append(packed.begin(), packed.end());
  }
};

} // namespace pcl_flashreg::io::forms
