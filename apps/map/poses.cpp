// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "poses.h"

#include "../io/csv.h"

#include <algorithm>
#include <filesystem>

namespace pcl_flashreg::map {
namespace {

std::string
stemOf(const ScanFile& scan)
{
  return std::filesystem::path(scan.path).stem().string();
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

/** \brief What stands for each scan in a file that knows no names. */
std::vector<std::string>
numbersOf(const std::vector<ScanFile>& scans)
{
  const bool are_numbers =
      std::all_of(scans.begin(), scans.end(), [](const auto& scan) {
        return isNumber(stemOf(scan));
      });
  std::vector<std::string> numbers;
  for (std::size_t i = 0; i < scans.size(); ++i)
    numbers.push_back(are_numbers ? stemOf(scans[i]) : std::to_string(i));
  return numbers;
}

std::string
joined(const std::vector<std::string>& words)
{
  std::string line;
  for (const std::string& word : words)
    line += (line.empty() ? "" : " ") + word;
  return line;
}

/** \brief A comment ends with its line. */
std::string
inOneLine(std::string name)
{
  std::replace(name.begin(), name.end(), '\n', ' ');
  return name;
}

} // namespace

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
  return io::toText(value + 0.0);
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
formatTum(const MapRun& run, std::size_t group)
{
  const std::vector<std::string> numbers = numbersOf(run.scans);
  std::string text = "# number tx ty tz qx qy qz qw\n";
  for (const std::size_t scan : run.result.groups[group])
    text += "# " + numbers[scan] + ": " + inOneLine(run.scans[scan].name) + '\n';
  for (const std::size_t scan : run.result.groups[group])
    text += numbers[scan] + ' ' +
            joined(poseCells(run.result.scans[scan].T_group_scan)) + '\n';
  return text;
}

std::string
formatKitti(const MapRun& run, std::size_t group)
{
  std::string text;
  for (const std::size_t scan : run.result.groups[group]) {
    const Eigen::Matrix4d matrix =
        run.result.scans[scan].T_group_scan.toMatrix<double>();
    std::vector<std::string> words;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column)
        words.push_back(numberText(matrix(row, column)));
    text += joined(words) + '\n';
  }
  return text;
}

std::string
formatCsv(const MapRun& run)
{
  std::vector<std::string> columns{"name", "group", "confidence", "edges"};
  columns.insert(columns.end(), {"tx", "ty", "tz", "qx", "qy", "qz", "qw"});
  std::string text = io::joinCsv(columns) + '\n';
  for (std::size_t i = 0; i < run.scans.size(); ++i) {
    const ScanPlace& place = run.result.scans[i];
    const bool placed = isPlaced(run.result, i);
    std::vector<std::string> cells{inOneLine(run.scans[i].name),
                                   placed ? std::to_string(place.group + 1) : "",
                                   numberText(place.confidence),
                                   std::to_string(place.edges)};
    if (placed)
      for (const std::string& cell : poseCells(place.T_group_scan))
        cells.push_back(cell);
    cells.resize(columns.size());
    text += io::joinCsv(cells) + '\n';
  }
  return text;
}

} // namespace pcl_flashreg::map
