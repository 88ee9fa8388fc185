// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cloud.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

/** \brief Walks through the lines of a text; line ends are LF or CR LF. */
class LineReader {
public:
  explicit LineReader(std::string_view text) : text_(text) {}

  /** \brief The next line without its end; false at the end of the text. */
  bool
  next(std::string_view& line);

  /** \brief Number of the line that next() gave last, from 1. */
  std::size_t
  lineNumber() const
  {
    return number_;
  }

  /** \brief Bytes read so far: where the line after the last one starts. */
  std::size_t
  position() const
  {
    return position_;
  }

private:
  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t number_ = 0;
};

/** \brief Takes the next word, bounded by blanks (and commas, if asked for), off the
 * front of a line; empty if there is none. */
std::string_view
takeWord(std::string_view& line, bool commas_too = false);

/** \brief All words of a line. */
std::vector<std::string_view>
splitWords(std::string_view line, bool commas_too = false);

/** \brief A word between quotes as a message shows it: its beginning, in ASCII. */
std::string
quoted(std::string_view word);

/** \brief Whether a word begins so, in letters of either case.
 * \param[in] beginning in lower case
 */
bool
beginsWith(std::string_view word, std::string_view beginning);

/** \brief The whole of a word as a number. Those that are not finite count, as C and
 * Microsoft's C write them: "nan", "-nan(ind)", "Inf", "-1.#IND", "1.#INF". */
bool
parseDouble(std::string_view word, double& value);

/** \brief The numbers of "1,2,3"; nothing if it is not made of numbers, all finite. */
std::optional<std::vector<double>>
numbersIn(std::string_view text);

/** \brief The whole of a word as a non-negative integer. */
bool
parseUnsigned(std::string_view word, std::size_t& value);

/** \brief The number that a word begins with, whatever follows it: of "640," it is 640,
 * of "0.5f" 0.5. */
bool
parseLeadingDouble(std::string_view word, double& value);

/** \brief Writes the number that a word is into value k of a field of a point; false if
 * the word is none, or does not fit the type of the field: out of its range, or no
 * integer. 64-bit integers keep all digits. */
bool
storeExactly(std::string_view word,
             std::uint8_t* point,
             const Field& field,
             std::size_t k);

/** \brief The same, but what is no integer is rounded to one. */
bool
storeWord(std::string_view word,
          std::uint8_t* point,
          const Field& field,
          std::size_t k);

} // namespace pcl_flashreg::io
