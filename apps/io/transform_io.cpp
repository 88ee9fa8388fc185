// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "transform_io.h"

#include "error.h"
#include "number_table.h"

#include <Eigen/Geometry>

#include <limits>
#include <locale>
#include <sstream>

namespace pcl_flashreg::io {
namespace {

/** \brief By how much matrices may be off that people print with few digits. */
constexpr double ROUNDED = 1e-2;

} // namespace

std::optional<RigidTransform>
rigidOf(const Eigen::Matrix<double, 3, 4>& matrix)
{
  const Eigen::Matrix3d rotation = matrix.leftCols<3>();
  if (!matrix.allFinite() || rotation.determinant() < 0 ||
      !(rotation.transpose() * rotation).isIdentity(ROUNDED))
    return std::nullopt;
  RigidTransform result;
  result.rotation = Eigen::Quaterniond(rotation).normalized().toRotationMatrix();
  result.translation = matrix.col(3);
  return result;
}

RigidTransform
toRigidTransform(const Eigen::Matrix4d& matrix)
{
  const Eigen::RowVector4d last_row(0, 0, 0, 1);
  const std::optional<RigidTransform> result = rigidOf(matrix.topRows<3>());
  if (!result || !matrix.bottomRows<1>().isApprox(last_row, ROUNDED))
    throw InputError("is no rigid transform: a rotation with determinant +1, a "
                     "translation, and 0 0 0 1 in the last row are expected");
  return *result;
}

RigidTransform
parseTransform(std::string_view text)
{
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor>;
  const NumberTable table = parseNumberTable(text);
  const auto n = static_cast<Eigen::Index>(table.values.size());
  if ((n != 16 && n != 12) || (table.columns != 4 && table.rows() != 1))
    throw InputError("holds " + std::to_string(n) +
                     " numbers, expected a 4 x 4 matrix by rows");
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topRows(n / 4) = Eigen::Map<const Rows>(table.values.data(), n / 4, 4);
  return toRigidTransform(matrix);
}

std::string
formatTransform(const RigidTransform& transform)
{
  const Eigen::Matrix4d matrix = transform.toMatrix<double>();
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      text << matrix(row, column) << (column < 3 ? ' ' : '\n');
  return text.str();
}

} // namespace pcl_flashreg::io
