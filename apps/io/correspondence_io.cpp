// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "correspondence_io.h"

#include "error.h"

#include <pcl_flashreg/impl/number_text.hpp>

#include <cmath>

namespace pcl_flashreg::io {
namespace {

using ConstRows =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>>;

/** \brief The table with a column for each of its rows. */
ConstRows
transposed(const NumberTable& table)
{
  return {table.values.data(),
          static_cast<Eigen::Index>(table.columns),
          static_cast<Eigen::Index>(table.rows())};
}

Eigen::Index
indexAt(const NumberTable& table,
        std::size_t row,
        std::size_t column,
        const Eigen::Matrix3Xd& points)
{
  const double value = table.row(row)[column];
  if (value >= 0 && value < static_cast<double>(points.cols()) &&
      value == std::floor(value))
    return static_cast<Eigen::Index>(value);
  const bool is_integer = std::abs(value) < 1e15 && value == std::floor(value);
  const std::string number = is_integer ? std::to_string(static_cast<long long>(value))
                                        : detail::toText(value);
  throw InputError("line " + std::to_string(table.lines[row]) + ": " + number +
                   " is no index of a " + (column == 0 ? "source" : "target") +
                   " point (0 to " + std::to_string(points.cols() - 1) + ")");
}

} // namespace

CorrespondenceForm
formOf(const NumberTable& table)
{
  if (table.columns == 6)
    return CorrespondenceForm::Coordinates;
  if (table.columns == 2)
    return CorrespondenceForm::Indices;
  throw InputError("line " + std::to_string(table.lines.at(0)) + ": found " +
                   std::to_string(table.columns) +
                   " numbers, expected 6 (sx sy sz tx ty tz) or 2 (source_index "
                   "target_index)");
}

Correspondences
fromCoordinates(const NumberTable& table)
{
  return {transposed(table).topRows(3), transposed(table).bottomRows(3)};
}

Correspondences
fromIndices(const NumberTable& table,
            const Eigen::Matrix3Xd& source,
            const Eigen::Matrix3Xd& target)
{
  Correspondences result;
  const auto n = static_cast<Eigen::Index>(table.rows());
  result.source.resize(3, n);
  result.target.resize(3, n);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    result.source.col(column) = source.col(indexAt(table, i, 0, source));
    result.target.col(column) = target.col(indexAt(table, i, 1, target));
  }
  return result;
}

Correspondences
fromPointTables(const NumberTable& source, const NumberTable& target)
{
  for (const NumberTable* table : {&source, &target})
    if (table->columns != 3)
      throw InputError("line " + std::to_string(table->lines.at(0)) + " of the " +
                       (table == &source ? "source" : "target") + " file: found " +
                       std::to_string(table->columns) + " numbers, expected 3 (x y z)");
  if (source.rows() != target.rows())
    throw InputError("the source file has " + std::to_string(source.rows()) +
                     " rows, the target file " + std::to_string(target.rows()) +
                     ": row i of both must be one correspondence");
  return {transposed(source), transposed(target)};
}

} // namespace pcl_flashreg::io
