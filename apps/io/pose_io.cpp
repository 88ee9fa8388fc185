// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pose_io.h"

#include "csv.h"

#include <algorithm>
#include <filesystem>

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
  const bool are_numbers =
      std::all_of(paths.begin(), paths.end(), [](const std::string& path) {
        return isNumber(stemOf(path));
      });
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

} // namespace pcl_flashreg::io
