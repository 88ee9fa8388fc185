// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "number_table.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>

namespace pcl_flashreg::io {

/** \brief Putative correspondences: column i of one matrix belongs to column i of the
 * other. Memory is N x 3, row-major. */
struct Correspondences {
  Eigen::Matrix3Xd source;
  Eigen::Matrix3Xd target;

  std::size_t
  size() const
  {
    return static_cast<std::size_t>(source.cols());
  }
};

/** \brief What a file of correspondences can hold. */
enum class CorrespondenceForm {
  /** \brief Rows of sx sy sz tx ty tz. */
  Coordinates,
  /** \brief Rows of source_index target_index, from 0. */
  Indices
};

/** \brief Which form a table has, by its number of columns.
 * \throws InputError if it has neither 6 nor 2
 */
CorrespondenceForm
formOf(const NumberTable& table);

/** \brief Correspondences from a table of six columns. */
Correspondences
fromCoordinates(const NumberTable& table);

/** \brief Correspondences from a table of two columns and the points that it names.
 * \throws InputError with the number of the line, if a number is no index of a point
 */
Correspondences
fromIndices(const NumberTable& table,
            const Eigen::Matrix3Xd& source,
            const Eigen::Matrix3Xd& target);

/** \brief Correspondences from two tables of three columns.
 * \throws InputError if they have another number of columns, or unlike numbers of rows
 */
Correspondences
fromPointTables(const NumberTable& source, const NumberTable& target);

} // namespace pcl_flashreg::io
