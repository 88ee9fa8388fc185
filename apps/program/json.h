// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>

#include <string>

namespace pcl_flashreg::program {

using Json = nlohmann::ordered_json;

/** \brief An array of the rows. */
template <typename Matrix>
Json
rowsOf(const Matrix& matrix)
{
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
      row.push_back(matrix(i, j));
    rows.push_back(row);
  }
  return rows;
}

/** \brief All of it in one line, with its end. */
inline std::string
lineOf(const Json& json)
{
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + '\n';
}

/** \brief The text that is written, with the end of its last line. */
inline std::string
textOf(const Json& json)
{
  // A path need not be valid UTF-8.
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

} // namespace pcl_flashreg::program
