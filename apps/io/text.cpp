// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace pcl_flashreg::io {
namespace {

bool
isBlank(char c, bool commas_too)
{
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f' ||
         (commas_too && c == ',');
}

std::string_view
withoutPlus(std::string_view word)
{
  if (word.size() > 1 && word[0] == '+' && word[1] != '-')
    word.remove_prefix(1);
  return word;
}

/** \brief What Microsoft's C library writes where a number is not finite: "1.#INF",
 * "-1.#IND", "1.#QNAN00". */
bool
parseMicrosoft(std::string_view word, double& value)
{
  const bool negative = word.substr(0, 1) == "-";
  word.remove_prefix(negative ? 1 : 0);
  if (word.substr(0, 3) != "1.#")
    return false;
  using Limits = std::numeric_limits<double>;
  value = word.substr(3, 3) == "INF" ? Limits::infinity() : Limits::quiet_NaN();
  if (negative)
    value = -value;
  return true;
}

template <typename Integer>
bool
storeInteger(std::string_view word, std::uint8_t* to)
{
  word = withoutPlus(word);
  Integer value = 0;
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size())
    return false;
  std::memcpy(to, &value, sizeof(value));
  return true;
}

/** \brief An integer that is written as one, whatever its size. */
bool
storeAsInteger(std::string_view word, std::uint8_t* to, ScalarType type)
{
  switch (type) {
  case ScalarType::Int8:
    return storeInteger<std::int8_t>(word, to);
  case ScalarType::Uint8:
    return storeInteger<std::uint8_t>(word, to);
  case ScalarType::Int16:
    return storeInteger<std::int16_t>(word, to);
  case ScalarType::Uint16:
    return storeInteger<std::uint16_t>(word, to);
  case ScalarType::Int32:
    return storeInteger<std::int32_t>(word, to);
  case ScalarType::Uint32:
    return storeInteger<std::uint32_t>(word, to);
  case ScalarType::Int64:
    return storeInteger<std::int64_t>(word, to);
  case ScalarType::Uint64:
    return storeInteger<std::uint64_t>(word, to);
  default:
    return false;
  }
}

} // namespace

bool
LineReader::next(std::string_view& line)
{
  if (position_ >= text_.size())
    return false;
  const std::size_t end = text_.find('\n', position_);
  line = text_.substr(position_, end - position_);
  position_ = end == std::string_view::npos ? text_.size() : end + 1;
  if (!line.empty() && line.back() == '\r')
    line.remove_suffix(1);
  ++number_;
  return true;
}

std::string_view
takeWord(std::string_view& line, bool commas_too)
{
  std::size_t begin = 0;
  while (begin < line.size() && isBlank(line[begin], commas_too))
    ++begin;
  std::size_t end = begin;
  while (end < line.size() && !isBlank(line[end], commas_too))
    ++end;
  const std::string_view word = line.substr(begin, end - begin);
  line.remove_prefix(end);
  return word;
}

std::vector<std::string_view>
splitWords(std::string_view line, bool commas_too)
{
  std::vector<std::string_view> words;
  while (true) {
    const std::string_view word = takeWord(line, commas_too);
    if (word.empty())
      return words;
    words.push_back(word);
  }
}

std::string
quoted(std::string_view word)
{
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "'";
  for (const char c : word.substr(0, 40)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte < 127)
      text += c;
    else
      text += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
  }
  return text + "'";
}

bool
beginsWith(std::string_view word, std::string_view beginning)
{
  return word.size() >= beginning.size() &&
         std::equal(
             beginning.begin(), beginning.end(), word.begin(), [](char a, char b) {
               return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b);
             });
}

bool
parseDouble(std::string_view word, double& value)
{
  word = withoutPlus(word);
  if (word.empty())
    return false;
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size())
    return parseMicrosoft(word, value);
  if (error == std::errc::result_out_of_range) {
    // from_chars does not say on which side: a negative exponent means too small.
    const std::size_t exponent = word.find_first_of("eE");
    const bool tiny = exponent == std::string_view::npos ? word.find('.') <= 1
                                                         : word[exponent + 1] == '-';
    value = tiny ? 0.0 : std::numeric_limits<double>::infinity();
    if (word[0] == '-')
      value = -value;
    return true;
  }
  return error == std::errc();
}

std::optional<std::vector<double>>
numbersIn(std::string_view text)
{
  std::vector<double> numbers;
  for (const std::string_view word : splitWords(text, /* commas_too */ true)) {
    double value = 0;
    if (!parseDouble(word, value) || !std::isfinite(value))
      return std::nullopt;
    numbers.push_back(value);
  }
  return numbers;
}

bool
parseUnsigned(std::string_view word, std::size_t& value)
{
  word = withoutPlus(word);
  const auto [end, error] =
      std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size() && !word.empty();
}

bool
parseLeadingDouble(std::string_view word, double& value)
{
  word = withoutPlus(word);
  return std::from_chars(word.data(), word.data() + word.size(), value).ec ==
         std::errc();
}

bool
storeExactly(std::string_view word,
             std::uint8_t* point,
             const Field& field,
             std::size_t k)
{
  std::uint8_t* to = point + field.offset + k * sizeOf(field.type);
  if (storeAsInteger(word, to, field.type))
    return true;
  double value = 0;
  if (!parseDouble(word, value))
    return false;
  storeValue(point, field, value, k);
  // As doubles, the largest 64-bit integers are those that do not fit any more.
  return isFloat(field.type) ||
         (std::abs(value) < 0x1p63 && loadValue(point, field, k) == value);
}

bool
storeWord(std::string_view word, std::uint8_t* point, const Field& field, std::size_t k)
{
  double value = 0;
  return storeExactly(word, point, field, k) ||
         (parseDouble(word, value) &&
          loadValue(point, field, k) == std::nearbyint(value));
}

} // namespace pcl_flashreg::io
