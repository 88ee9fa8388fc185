// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "row_length.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

namespace pcl_flashreg::io {
namespace {

/** \brief Values that make up a 32nd of the table or more have a class of their own, the
 * others share as many classes of about that size. */
constexpr std::size_t kClasses = 32;

/** \brief The upper half of a float32, so that a larger value has a larger key. */
std::size_t
keyOf(const char* value)
{
  std::uint32_t bits = 0;
  std::memcpy(&bits, value, sizeof(bits));
  const std::uint32_t upper = bits >> 16;
  return (upper & 0x8000u) != 0 ? upper ^ 0xffffu : upper | 0x8000u;
}

/** \brief The table's values, each replaced by its class. */
struct Classes {
  std::vector<std::uint8_t> values;
  std::size_t number = 0;
};

Classes
classify(std::string_view bytes)
{
  Classes classes;
  const std::size_t n = bytes.size() / sizeof(float);
  std::vector<std::size_t> counts(std::size_t{1} << 16);
  for (std::size_t i = 0; i < n; ++i)
    ++counts[keyOf(bytes.data() + i * sizeof(float))];
  const std::size_t full = n / kClasses + 1;
  std::vector<std::uint8_t> class_of(counts.size());
  std::size_t filled = 0;
  for (std::size_t key = 0; key < counts.size(); ++key) {
    if (counts[key] == 0)
      continue;
    if (filled == 0 || filled + counts[key] > full) {
      ++classes.number;
      filled = 0;
    }
    filled += counts[key];
    class_of[key] = static_cast<std::uint8_t>(classes.number - 1);
  }
  classes.values.resize(n);
  for (std::size_t i = 0; i < n; ++i)
    classes.values[i] = class_of[keyOf(bytes.data() + i * sizeof(float))];
  return classes;
}

/** \brief What the column says about the class of a value if rows have that length:
 * their mutual information, in nats, less what chance makes of it. Rows all of whose
 * values are of one class don't count: zeros, say, for a beam that met nothing. */
double
informationOf(const Classes& classes, std::size_t length)
{
  const std::size_t rows = classes.values.size() / length;
  std::vector<std::size_t> counts(classes.number * length);
  const std::uint8_t* value = classes.values.data();
  std::size_t used_rows = 0;
  for (std::size_t row = 0; row < rows; ++row, value += length) {
    if (std::all_of(value, value + length, [&](auto v) { return v == *value; }))
      continue;
    ++used_rows;
    for (std::size_t column = 0; column < length; ++column)
      ++counts[value[column] * length + column];
  }
  if (used_rows == 0)
    return 0;
  const auto total = static_cast<double>(used_rows * length);
  double information = 0;
  std::size_t used = 0;
  for (std::size_t k = 0; k < classes.number; ++k) {
    const std::size_t* of_class = counts.data() + k * length;
    std::size_t sum = 0;
    for (std::size_t column = 0; column < length; ++column)
      sum += of_class[column];
    used += sum > 0 ? 1 : 0;
    for (std::size_t column = 0; column < length; ++column)
      if (of_class[column] > 0) {
        const auto count = static_cast<double>(of_class[column]);
        information += count * std::log(count * static_cast<double>(length) /
                                        static_cast<double>(sum));
      }
  }
  const auto freedom = static_cast<double>((used - 1) * (length - 1));
  return (information - freedom / 2) / total;
}

/** \brief Calls function(row) for every row of that length that isn't empty: zeros alone,
 * or no numbers. */
template <typename Function>
void
forEachRow(std::string_view bytes, std::size_t length, Function&& function)
{
  std::array<float, kLongestRow> row{};
  const std::size_t size = length * sizeof(float);
  for (std::size_t at = 0; at + size <= bytes.size(); at += size) {
    std::memcpy(row.data(), bytes.data() + at, size);
    if (std::any_of(row.begin(), row.end(), [](float v) { return std::abs(v) > 0; }))
      function(row);
  }
}

/** \brief Whether three columns behind x, y and z are unit vectors: normals. Where
 * coordinates are of about that size, they tell little else from points. */
bool
hasNormals(std::string_view bytes, std::size_t length)
{
  std::array<std::size_t, kLongestRow> units{};
  std::size_t rows = 0;
  forEachRow(bytes, length, [&](const auto& row) {
    ++rows;
    for (std::size_t k = 3; k + 2 < length; ++k) {
      const double square = double(row[k]) * row[k] + double(row[k + 1]) * row[k + 1] +
                            double(row[k + 2]) * row[k + 2];
      units[k] += std::abs(square - 1) < 1e-2 ? 1 : 0;
    }
  });
  for (const std::size_t count : units)
    if (count * 10 > rows * 8)
      return true;
  return false;
}

/** \brief Whether rows of that length are made of a few points that lie in the same
 * direction from the origin, as neighbouring beams of a turning lidar do. */
bool
looksTheSameWay(std::string_view bytes, std::size_t length, std::size_t part)
{
  std::size_t rows = 0, same = 0, positive_x = 0, positive_y = 0;
  forEachRow(bytes, length, [&](const auto& row) {
    bool present = true, agrees = true;
    for (std::size_t k = 0; k < length; k += part) {
      const float x = row[k], y = row[k + 1];
      present = present && std::abs(x) > 0 && std::abs(y) > 0;
      agrees = agrees && (x > 0) == (row[0] > 0) && (y > 0) == (row[1] > 0);
    }
    if (!present)
      return;
    ++rows;
    same += agrees ? 1 : 0;
    positive_x += row[0] > 0 ? 1 : 0;
    positive_y += row[1] > 0 ? 1 : 0;
  });
  const auto both_signs = [&](std::size_t positive) {
    return positive * 20 > rows && (rows - positive) * 20 > rows;
  };
  return same * 10 > rows * 9 && both_signs(positive_x) && both_signs(positive_y);
}

/** \brief Whether one part of the rows is empty, and others are not: columns of zeros. */
bool
hasEmptyPart(std::string_view bytes, std::size_t length, std::size_t part)
{
  std::array<std::size_t, kLongestRow> filled{};
  std::size_t rows = 0;
  forEachRow(bytes, length, [&](const auto& row) {
    ++rows;
    for (std::size_t k = 0; k < length; ++k)
      filled[k / part] += std::abs(row[k]) > 0 ? 1 : 0;
  });
  return std::any_of(filled.data(), filled.data() + length / part, [&](auto n) {
    return n * 20 < rows;
  });
}

/** \brief Whether a row is several rows: it tells as much as one of them, or more only
 * since the beams of a lidar take turns.
 * \param[in] gain what it tells more, 1 where no two of them have values in common */
bool
isSeveralRows(std::string_view bytes, std::size_t length, std::size_t part, double gain)
{
  if (hasEmptyPart(bytes, length, part) ||
      (hasNormals(bytes, length) && !hasNormals(bytes, part)))
    return false;
  return gain < 0.2 || looksTheSameWay(bytes, length, part);
}

using Information = std::array<double, kLongestRow + 1>;

/** \brief The row that rows of a length are several of; 0 if they are not. Where more than
 * one will do, the one that tells most. */
std::size_t
partOf(std::string_view bytes, std::size_t length, const Information& information)
{
  std::vector<std::pair<double, std::size_t>> parts;
  for (std::size_t number = 2; length / number >= kShortestRow; ++number)
    if (length % number == 0) {
      const std::size_t part = length / number;
      const double gain = information[length] - information[part];
      parts.emplace_back(gain / std::log(static_cast<double>(number)), part);
    }
  std::sort(parts.begin(), parts.end());
  for (const auto& [gain, part] : parts)
    if (isSeveralRows(bytes, length, part, gain))
      return part;
  return 0;
}

} // namespace

std::size_t
rowLengthOf(std::string_view bytes)
{
  if (bytes.size() < sizeof(float) * kLongestRow)
    return 0;
  const Classes classes = classify(bytes);
  Information information{};
  for (std::size_t length = 2; length <= kLongestRow; ++length)
    information[length] = informationOf(classes, length);
  const auto shortest = information.begin() + kShortestRow;
  auto best = static_cast<std::size_t>(std::max_element(shortest, information.end()) -
                                       information.begin());
  while (const std::size_t part = partOf(bytes, best, information))
    best = part;
  constexpr double least = 0.1;
  if (information[best] < least)
    return 0;
  // Lengths with a common divisor tell what rows of that divisor tell.
  for (std::size_t length = kShortestRow; length <= kLongestRow; ++length)
    if (length % best != 0 &&
        information[length] - information[std::gcd(length, best)] >
            information[best] / 2)
      return 0;
  return best;
}

} // namespace pcl_flashreg::io
