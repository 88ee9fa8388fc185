// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "kitti.h"

#include "../../io/error.h"
#include "../../io/file.h"
#include "../../io/text.h"
#include "../../io/transform_io.h"

#include <algorithm>
#include <filesystem>

namespace pcl_flashreg::evaluate {
namespace {

namespace fs = std::filesystem;
using Poses = std::vector<Eigen::Isometry3d>;

constexpr double DISTANCE = 10;
constexpr std::size_t WINDOW = 100;

std::string
padded(std::size_t number, std::size_t digits)
{
  const std::string text = std::to_string(number);
  return std::string(digits - std::min(digits, text.size()), '0') + text;
}

Eigen::Isometry3d
parseLine(std::string_view line, std::size_t number)
{
  try {
    return io::parseTransform(line).toIsometry();
  }
  catch (const io::InputError& error) {
    throw io::InputError("line " + std::to_string(number) + ": " + error.what());
  }
}

/** \brief T_camera_lidar. */
Eigen::Isometry3d
parseCalibration(const std::string& text)
{
  io::LineReader lines(text);
  for (std::string_view line; lines.next(line);)
    for (const std::string_view key : {"Tr:", "Tr_velo_to_cam:"})
      if (line.substr(0, key.size()) == key)
        return parseLine(line.substr(key.size()), lines.lineNumber());
  throw io::InputError("has no line that begins with Tr:");
}

Poses
parsePoses(const std::string& text)
{
  Poses poses;
  io::LineReader lines(text);
  for (std::string_view line; lines.next(line);)
    if (!io::splitWords(line).empty())
      poses.push_back(parseLine(line, lines.lineNumber()));
  return poses;
}

/** \brief Frames of the pairs, by the rule stated at readKitti(). */
std::vector<std::pair<std::size_t, std::size_t>>
framesApart(const Poses& poses)
{
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0; i < poses.size();) {
    const std::size_t end = std::min(poses.size(), i + WINDOW);
    std::size_t j = i + 1;
    while (j < end &&
           (poses[j].translation() - poses[i].translation()).norm() <= DISTANCE)
      ++j;
    const bool found = j < end && j > i + 1;
    if (found)
      pairs.emplace_back(i, j - 1);
    i = found ? j : i + 1;
  }
  return pairs;
}

void
appendSequence(DataSet& data, std::size_t sequence)
{
  const std::string name = padded(sequence, 2);
  const std::string folder = "sequences/" + name;
  const std::string poses_file = data.root + "/poses/" + name + ".txt";
  const Eigen::Isometry3d T_camera_lidar =
      io::parseFile(data.root + "/" + folder + "/calib.txt", parseCalibration);
  const Poses poses = io::parseFile(poses_file, parsePoses);
  for (const auto& [source, target] : framesApart(poses)) {
    if (sequence == 8 && source == 15 && target == 58)
      continue;
    Pair pair;
    pair.dataset = "KITTI";
    pair.scene = name;
    pair.source = folder + "/velodyne/" + padded(source, 6) + ".bin";
    pair.target = folder + "/velodyne/" + padded(target, 6) + ".bin";
    for (const std::string& scan : {pair.source, pair.target})
      if (!fs::exists(data.root + "/" + scan))
        throw io::InputError(data.root + "/" + scan + " is not there, but " +
                             poses_file + " has its pose");
    const Eigen::Isometry3d T = T_camera_lidar.inverse() * poses[target].inverse() *
                                poses[source] * T_camera_lidar;
    pair.T_target_source = {T.linear(), T.translation()};
    pair.refine_truth = true;
    data.pairs.push_back(pair);
  }
}

} // namespace

bool
isKitti(const std::string& root)
{
  return fs::is_directory(root + "/sequences") && fs::is_directory(root + "/poses");
}

DataSet
readKitti(const std::string& root, const std::vector<int>& sequences)
{
  DataSet data;
  data.root = root;
  data.leaf = 0.3;
  data.criterion = {5, 0.6};
  data.bin_fields = 4;
  for (const int sequence : sequences)
    appendSequence(data, static_cast<std::size_t>(sequence));
  return data;
}

} // namespace pcl_flashreg::evaluate
