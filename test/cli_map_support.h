// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the tests of pcl_flashreg_map share: scans of a made room in a folder of their own,
// and the program on them.

#include "cli_clouds.h"
#include "support/made_room.h"
#include "support/program.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace pcl_flashreg::map {

namespace fs = std::filesystem;

/** \brief A scan of one side of a room, in a frame of its own. */
struct MadeScan {
  io::Cloud cloud;
  Eigen::Isometry3d T_room_scan = Eigen::Isometry3d::Identity();
};

/** \brief Of eight scans around the room each sees two thirds of it. */
inline MadeScan
madeScan(std::size_t number, double points_per_square_metre = 250)
{
  const made::Room room(100 + number, points_per_square_metre, 0.004);
  const double middle = 0.785398163397 * static_cast<double>(number);
  MadeScan scan;
  if (number > 0)
    scan.T_room_scan = made::Random(number).pose(2).inverse();
  std::vector<Eigen::Vector3d> points;
  for (const Eigen::Vector3d& point : room.points()) {
    const double angle = std::atan2(point.y() - 1.1, point.x() - 1.4) - middle;
    if (std::cos(angle) > -0.5)
      points.push_back(scan.T_room_scan.inverse() * point);
  }
  scan.cloud = cloudOf(points);
  const Eigen::Vector3d eye =
      scan.T_room_scan.inverse() * Eigen::Vector3d(1.6, 2.0, 1.8);
  std::copy(eye.data(), eye.data() + 3, scan.cloud.viewpoint.begin());
  return scan;
}

class MapTest : public ProgramTest {
protected:
  static constexpr const char* LEAF = " --leaf 0.1";

  /** \brief Runs the program in the folder.
   * \param[in] arguments as they are typed into a shell */
  ProgramRun
  makeMap(const std::string& arguments, const std::string& launcher = "") const
  {
    return runProgram(PCL_FLASHREG_MAP, arguments, launcher);
  }

  /** \brief Scans from a number on as scans/scan_N.pcd. */
  void
  writeScans(std::size_t from, std::size_t to) const
  {
    fs::create_directories(path("scans"));
    for (std::size_t i = from; i < to; ++i)
      io::writeCloud(path("scans/scan_" + std::to_string(i) + ".pcd"),
                     madeScan(i).cloud);
  }

  /** \brief A blob that fits nothing. */
  void
  writeBlob(const std::string& name) const
  {
    io::writeCloud(path(name), cloudOf(blobPoints()));
  }

  void
  expectFailure(const std::string& arguments, int status, const std::string& why) const
  {
    const ProgramRun run = makeMap(arguments);
    EXPECT_EQ(run.status, status) << arguments << '\n' << run.err;
    EXPECT_EQ(run.err.find("pcl_flashreg_map: error: "), 0u) << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }

  static Eigen::Isometry3d
  poseOf(const nlohmann::json& rows)
  {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 4; ++j)
        pose.matrix()(i, j) =
            rows.at(static_cast<std::size_t>(i)).at(static_cast<std::size_t>(j));
    return pose;
  }
};

/** \brief How far a pose of a scan moves the middle of the room from where it belongs, in
 * the frame of the first scan. */
inline double
errorOf(const Eigen::Isometry3d& pose, std::size_t number)
{
  const Eigen::Vector3d middle(1.5, 1.2, 0.6);
  return (pose * madeScan(number).T_room_scan.inverse() * middle -
          madeScan(0).T_room_scan.inverse() * middle)
      .norm();
}

} // namespace pcl_flashreg::map
