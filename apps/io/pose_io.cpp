// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pose_io.h"

#include "csv.h"
#include "error.h"
#include "number_table.h"
#include "text.h"
#include "transform_io.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

namespace pcl_flashreg::io {
namespace {

std::string
stemOf(const std::string& path)
{
  return std::filesystem::path(path).stem().string();
}

/** \brief Digits, and a point between them perhaps. */
bool
isNumber(const std::string& text)
{
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  return !text.empty() && is_digit(text.front()) && is_digit(text.back()) &&
         std::count(text.begin(), text.end(), '.') <= 1 &&
         text.find_first_not_of("0123456789.") == std::string::npos;
}

bool
namesAreNumbers(const std::vector<std::string>& paths)
{
  return std::all_of(paths.begin(), paths.end(), [](const std::string& path) {
    return isNumber(stemOf(path));
  });
}

std::string
joined(const std::vector<std::string>& words)
{
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + word;
  return line;
}

} // namespace

std::vector<std::string>
numbersOf(const std::vector<std::string>& paths)
{
  const bool are_numbers = namesAreNumbers(paths);
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < paths.size(); ++i)
    numbers.push_back(are_numbers ? stemOf(paths[i]) : std::to_string(i));
  return numbers;
}

Eigen::Quaterniond
quaternionOf(const RigidTransform& pose)
{
  Eigen::Quaterniond q(pose.rotation);
  q.normalize();
  if (q.w() < 0)
    q.coeffs() = -q.coeffs();
  return q;
}

std::string
numberText(double value)
{
  return toText(value + 0.0);
}

std::vector<std::string>
poseCells(const RigidTransform& pose)
{
  const Eigen::Vector3d& t = pose.translation;
  const Eigen::Quaterniond q = quaternionOf(pose);
  std::vector<std::string> cells;
  for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()})
    cells.push_back(numberText(value));
  return cells;
}

std::optional<RigidTransform>
poseOfCells(const double* cells)
{
  constexpr double ROUNDED = 0.01;
  const Eigen::Quaterniond q(cells[6], cells[3], cells[4], cells[5]);
  const Eigen::Vector3d t(cells[0], cells[1], cells[2]);
  if (!(std::abs(q.norm() - 1) < ROUNDED) || !t.allFinite())
    return std::nullopt;
  return RigidTransform{q.normalized().toRotationMatrix(), t};
}

std::string
inOneLine(std::string name)
{
  std::replace(name.begin(), name.end(), '\n', ' ');
  return name;
}

std::string
formatTum(const std::vector<PosedScan>& scans)
{
  std::string text = "# number tx ty tz qx qy qz qw\n";
  for (const PosedScan& scan : scans)
    text += "# " + scan.number + ": " + inOneLine(scan.name) + '\n';
  for (const PosedScan& scan : scans)
    text += scan.number + ' ' + joined(poseCells(scan.pose)) + '\n';
  return text;
}

std::string
formatKitti(const std::vector<PosedScan>& scans)
{
  std::string text;
  for (const PosedScan& scan : scans) {
    const Eigen::Matrix4d matrix = scan.pose.toMatrix<double>();
    std::vector<std::string> words;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        words.push_back(numberText(matrix(row, column)));
    text += joined(words) + '\n';
  }
  return text;
}

std::vector<NumberedPose>
parsePoses(std::string_view text)
{
  constexpr std::size_t TUM = 8, KITTI = 12;
  using Rows = Eigen::Matrix<double, 3, 4, Eigen::RowMajor>;
  const NumberTable table = parseNumberTable(text);
  if (table.columns != TUM && table.columns != KITTI)
    throw InputError("has rows of " + std::to_string(table.columns) +
                     " numbers: poses have 8 (number, translation, quaternion x y z w) "
                     "or 12 (the upper three rows of a matrix)");
  std::vector<NumberedPose> poses;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double* row = table.row(i);
    const bool is_tum = table.columns == TUM;
    const auto pose =
        is_tum ? poseOfCells(row + 1) : rigidOf(Eigen::Map<const Rows>(row));
    if (!pose || !std::isfinite(row[0]))
      throw InputError(atLine(table.lines[i]) + "is no pose: " +
                       (is_tum ? "the quaternion must have length 1, and all be finite"
                               : "the matrix must be a rotation and a translation"));
    poses.push_back({is_tum ? row[0] : static_cast<double>(i), *pose});
  }
  return poses;
}

std::vector<RigidTransform>
posesOf(const std::vector<std::string>& paths, const std::vector<NumberedPose>& poses)
{
  std::vector<RigidTransform> result;
  if (namesAreNumbers(paths)) {
    std::map<double, const RigidTransform*> by_number;
    for (const NumberedPose& entry : poses)
      by_number.emplace(entry.number, &entry.pose);
    for (const std::string& path : paths) {
      double number = 0;
      const auto found =
          parseDouble(stemOf(path), number) ? by_number.find(number) : by_number.end();
      if (found != by_number.end())
        result.push_back(*found->second);
    }
    if (result.size() == paths.size())
      return result;
  }
  if (poses.size() != paths.size())
    throw InputError("holds " + std::to_string(poses.size()) +
                     " poses, and there are " + std::to_string(paths.size()) +
                     " scans");
  result.clear();
  for (const NumberedPose& entry : poses)
    result.push_back(entry.pose);
  return result;
}

} // namespace pcl_flashreg::io
