// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "error.h"
#include "pcd_header.h"
#include "text.h"

#include <algorithm>

namespace pcl_flashreg::io {
namespace {

using Words = std::vector<std::string_view>;

/** \brief Which words of a point are which.
 *
 * Some programs write fields of one byte as characters. Where such a character is a
 * blank or the end of a line, the point has fewer words; those before the first such
 * field are still what they should be. */
struct RowLayout {
  /** \brief Words of a point. */
  std::size_t values = 0;
  /** \brief Words that can be missing: none, unless the coordinates are certain. */
  std::size_t bytes = 0;
  /** \brief Words before those. */
  std::size_t certain = 0;

  explicit RowLayout(const std::vector<PcdField>& fields)
  {
    bool uncertain = false;
    for (const PcdField& field : fields) {
      values += field.count;
      if (field.value_size == 1)
        bytes += field.count;
      if (bytes == 0)
        certain += field.count;
      else if (isCoordinate(field.name))
        uncertain = true;
    }
    if (uncertain) {
      bytes = 0;
      certain = values;
    }
  }
};

/** \brief Hands out the words of one point after the other. */
class RowReader {
public:
  RowReader(const PcdHeader& header, const RowLayout& layout)
      : lines_(header.body),
        lines_before_(header.lines),
        layout_(layout),
        begins_with_coordinate_(isCoordinate(header.fields.front().name))
  {
  }

  /** \brief As many words as the layout says; fewer where some may be missing. False at
   * the end of the body.
   * \throws InputError if there are more or fewer
   */
  bool
  next(Words& row)
  {
    if (!peek())
      return false;
    line_ = lines_before_ + lines_.lineNumber();
    row.clear();
    do {
      row.insert(row.end(), next_.begin(), next_.end());
      next_.clear();
    } while (goesOn(row.size()));
    if (row.size() > layout_.values || row.size() < layout_.values - layout_.bytes)
      throw errorAtLine(line_,
                        "expected " + std::to_string(layout_.values) +
                            " values, found " + std::to_string(row.size()));
    return true;
  }

  /** \brief Where the last point begins. */
  std::size_t
  line() const
  {
    return line_;
  }

private:
  /** \brief Whether the next line belongs to a point that has so many words so far. */
  bool
  goesOn(std::size_t words)
  {
    if (layout_.bytes == 0 || words >= layout_.values || !peek())
      return false;
    // No point has fewer words than this, and none begins with a line of fewer than the
    // certain ones.
    return words < layout_.values - layout_.bytes ||
           (next_.size() < layout_.certain && words + next_.size() <= layout_.values);
  }

  /** \brief Finds the next line that has words; false at the end. */
  bool
  peek()
  {
    for (std::string_view line; next_.empty() && lines_.next(line);) {
      next_ = wordsOf(line);
      if (!next_.empty() && isComment(next_))
        next_.clear();
    }
    return !next_.empty();
  }

  /** \brief Commas separate words where that makes as many of them as there should be.
   */
  Words
  wordsOf(std::string_view line) const
  {
    if (line.find(',') != std::string_view::npos) {
      Words words = splitWords(line, true);
      if (words.size() == layout_.values)
        return words;
    }
    return splitWords(line);
  }

  /** \brief A '#' can be the character of a field of one byte, too. */
  bool
  isComment(const Words& words) const
  {
    return words[0][0] == '#' &&
           (begins_with_coordinate_ || words.size() != layout_.values);
  }

  LineReader lines_;
  std::size_t lines_before_;
  RowLayout layout_;
  bool begins_with_coordinate_;
  Words next_;
  std::size_t line_ = 0;
};

/** \brief How the values of a field fit its type. */
enum class Fit { Exact, Number, None };

/** \brief What of a body does not fit the header. */
struct Misfits {
  struct Values {
    Fit fit = Fit::Exact;
    /** \brief Which value that was. */
    std::string example;
  };
  /** \brief One a field. */
  std::vector<Values> fields;
  /** \brief Whether a field of one byte has been written as characters. */
  bool characters = false;
  /** \brief The complaint about the first point with fewer words; empty if there is
   * none. */
  std::string missing;

  void
  add(const PcdField& field, std::size_t index, std::string_view word)
  {
    double number = 0;
    const Fit fit = parseDouble(word, number) ? Fit::Number : Fit::None;
    if (fit == Fit::None && field.value_size == 1 && word.size() == 1)
      characters = true;
    if (fit > fields[index].fit)
      fields[index] = {fit, quoted(word)};
  }

  bool
  none() const
  {
    return missing.empty() &&
           std::all_of(fields.begin(), fields.end(), [](const Values& values) {
             return values.fit == Fit::Exact;
           });
  }
};

/** \brief Reads the points as the header has them, and what does not fit it. */
Cloud
readRows(const PcdHeader& header, const RowLayout& layout, Misfits& misfits)
{
  // A value is one character and a blank or line end; the last one may lack that.
  Cloud cloud = makePcdCloud(header, 2 * layout.values, header.body.size() + 1);
  RowReader reader(header, layout);
  Words words;
  std::size_t i = 0;
  for (; i < cloud.size() && reader.next(words); ++i) {
    if (words.size() < layout.values) {
      if (misfits.missing.empty())
        misfits.missing = "line " + std::to_string(reader.line()) + " has " +
                          std::to_string(words.size()) + " of " +
                          std::to_string(layout.values) + " values";
      words.resize(layout.certain);
    }
    std::size_t word = 0, kept = 0;
    for (std::size_t f = 0; f < header.fields.size() && word < words.size(); ++f) {
      const PcdField& field = header.fields[f];
      if (!field.kept_as) {
        word += field.count;
        continue;
      }
      const Field& to = cloud.fields[kept++];
      for (std::size_t k = 0; k < field.count; ++k, ++word) {
        if (storeExactly(words[word], cloud.point(i), to, k))
          continue;
        misfits.add(field, f, words[word]);
        if (isCoordinate(field.name) && misfits.fields[f].fit == Fit::None)
          throw errorAtLine(reader.line(),
                            quoted(words[word]) + " is no value for the field " +
                                quoted(field.name));
      }
    }
  }
  if (i < cloud.size())
    throw InputError("is cut off: the header declares " + std::to_string(cloud.size()) +
                     " points, the body holds " + std::to_string(i));
  return cloud;
}

/** \brief Gives the fields types that all their values fit, or leaves them out. */
void
mend(PcdHeader& header, const RowLayout& layout, const Misfits& misfits)
{
  if (!misfits.missing.empty() && !misfits.characters)
    throw InputError(misfits.missing);
  std::size_t word = 0;
  for (std::size_t f = 0; f < header.fields.size(); ++f) {
    PcdField& field = header.fields[f];
    const Misfits::Values& values = misfits.fields[f];
    const std::string name = "the field " + quoted(field.name);
    if (field.kept_as && values.fit == Fit::None) {
      field.kept_as.reset();
      header.notes.push_back(name + " is left out: " + values.example +
                             " is no number");
    }
    else if (field.kept_as && word >= layout.certain && !misfits.missing.empty()) {
      field.kept_as.reset();
      header.notes.push_back(name + " is left out: " + misfits.missing);
    }
    else if (values.fit == Fit::Number) {
      field.kept_as = ScalarType::Float64;
      header.notes.push_back(name + " is read as double: " + values.example +
                             " does not fit its type");
    }
    word += field.count;
  }
}

} // namespace

Cloud
readPcdAscii(PcdHeader header)
{
  const RowLayout layout(header.fields);
  Misfits misfits;
  misfits.fields.resize(header.fields.size());
  Cloud cloud = readRows(header, layout, misfits);
  if (misfits.none())
    return cloud;
  mend(header, layout, misfits);
  return readRows(header, layout, misfits);
}

} // namespace pcl_flashreg::io
