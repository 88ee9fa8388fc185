// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "graph.h"

#include "../io/pose_io.h"

namespace pcl_flashreg::map {
namespace {

Eigen::Matrix3d
crossProductWith(const Eigen::Vector3d& v)
{
  Eigen::Matrix3d matrix;
  matrix << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return matrix;
}

std::string
poseText(const RigidTransform& pose)
{
  std::string text;
  for (const std::string& cell : io::poseCells(pose))
    text += ' ' + cell;
  return text;
}

std::string
vertexText(std::size_t scan, const RigidTransform& pose)
{
  return "VERTEX_SE3:QUAT " + std::to_string(scan) + poseText(pose) + '\n';
}

std::string
edgeText(const MapEdge& edge)
{
  std::string text = "EDGE_SE3:QUAT " + std::to_string(edge.target) + ' ' +
                     std::to_string(edge.source) + poseText(edge.T_target_source);
  const InformationMatrix information = informationForG2o(edge);
  for (int row = 0; row < 6; ++row)
    for (int column = row; column < 6; ++column)
      text += ' ' + io::numberText(information(row, column));
  return text + '\n';
}

} // namespace

InformationMatrix
informationForG2o(const MapEdge& edge)
{
  // From g2o's error (t, q) at the source to the motion (rotation, translation) about the
  // target's origin, which the information is of.
  const Eigen::Matrix3d& R = edge.T_target_source.rotation;
  InformationMatrix motion = InformationMatrix::Zero();
  motion.topRightCorner<3, 3>() = 2 * R;
  motion.bottomLeftCorner<3, 3>() = R;
  motion.bottomRightCorner<3, 3>() =
      2 * crossProductWith(edge.T_target_source.translation) * R;
  return motion.transpose() * edge.information * motion;
}

std::string
formatG2o(const MultiviewResult& result)
{
  std::string vertices, fixed, edges;
  for (const std::vector<std::size_t>& group : result.groups) {
    if (group.size() < 2)
      continue;
    fixed += "FIX " + std::to_string(group.front()) + '\n';
    for (const std::size_t scan : group)
      vertices += vertexText(scan, result.scans[scan].T_group_scan);
  }
  for (const MapEdge& edge : result.edges)
    if (edge.fate == EdgeFate::Used)
      edges += edgeText(edge);
  return vertices + fixed + edges;
}

} // namespace pcl_flashreg::map
