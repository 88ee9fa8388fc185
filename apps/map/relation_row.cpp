// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "relation_row.h"

#include <cmath>

namespace pcl_flashreg::map {
namespace {

std::string
poseText(const RelativePose& pose)
{
  std::string text = io::toText(pose.probability) + ' ' + std::to_string(pose.inliers);
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = 0; column < 3; ++column)
      text += ' ' + io::toText(pose.T_target_source.rotation(row, column));
    text += ' ' + io::toText(pose.T_target_source.translation[row]);
  }
  return text;
}

double
finiteNumber(std::string_view word)
{
  double value = 0;
  if (!io::parseDouble(word, value) || !std::isfinite(value))
    throw io::InputError("column poses: '" + io::quoted(word) + "' is not a number");
  return value;
}

RelativePose
poseFromText(std::string_view text)
{
  constexpr std::size_t NUMBERS = 14;
  const std::vector<std::string_view> words = io::splitWords(text);
  std::size_t inliers = 0;
  if (words.size() != NUMBERS || !io::parseUnsigned(words[1], inliers))
    throw io::InputError("column poses: '" + io::quoted(text) + "' is not a pose");
  RelativePose pose;
  pose.probability = finiteNumber(words[0]);
  pose.inliers = static_cast<int>(inliers);
  for (Eigen::Index row = 0; row < 3; ++row) {
    const auto* of_row = &words[2 + 4 * static_cast<std::size_t>(row)];
    for (Eigen::Index column = 0; column < 3; ++column)
      pose.T_target_source.rotation(row, column) = finiteNumber(of_row[column]);
    pose.T_target_source.translation[row] = finiteNumber(of_row[3]);
  }
  return pose;
}

} // namespace

batch::Cells
relationColumns()
{
  return {"target", "source", "overruled_viewpoints", "poses"};
}

batch::Cells
relationCells(const ScanRelation& relation)
{
  std::string poses;
  for (const RelativePose& pose : relation.poses)
    poses += (poses.empty() ? "" : ";") + poseText(pose);
  return {std::to_string(relation.target),
          std::to_string(relation.source),
          relation.overruled_viewpoints ? "1" : "0",
          poses};
}

ScanRelation
relationFromCells(const batch::Cells& cells)
{
  const batch::Cells columns = relationColumns();
  batch::CellReader reader(cells, columns);
  ScanRelation relation;
  relation.target = reader.count();
  relation.source = reader.count();
  relation.overruled_viewpoints = reader.flag();
  std::string_view poses = reader.text();
  while (!poses.empty()) {
    const std::size_t end = std::min(poses.find(';'), poses.size());
    relation.poses.push_back(poseFromText(poses.substr(0, end)));
    poses.remove_prefix(std::min(end + 1, poses.size()));
  }
  return relation;
}

} // namespace pcl_flashreg::map
