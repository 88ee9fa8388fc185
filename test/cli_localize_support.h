// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the tests of pcl_flashreg_localize share: a made hall as a map, scans of it in a
// folder of their own, and the program on them.

#include "cli_clouds.h"
#include "support/made_hall_scans.h"
#include "support/made_room.h"
#include "support/program.h"

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace pcl_flashreg::localize {

namespace fs = std::filesystem;

class LocalizeTest : public ProgramTest {
protected:
  using Lines = std::vector<nlohmann::json>;
  static constexpr const char* LEAF = " --leaf 0.1";
  static constexpr std::size_t SCANS = 6;

  void
  SetUp() override
  {
    ProgramTest::SetUp();
    writeMap("map.pcd");
  }

  /** \brief The hall, and a room 15 m from it, so that it is more than a scan can see.
   * Other points of the same surfaces than those of the scans. */
  void
  writeMap(const std::string& name, double shift = 0) const
  {
    static const made::HallScans hall(true, 15000);
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < SCANS; ++i)
      for (const Eigen::Vector3d& point : hall.scans[i])
        points.push_back(hall.T_hall_scan[i] * point);
    static const made::Room room(7, 800, 0.004);
    for (const Eigen::Vector3d& point : room.points())
      points.push_back(point + Eigen::Vector3d(15, 0, 0));
    for (Eigen::Vector3d& point : points)
      point.x() += shift;
    io::writeCloud(path(name), cloudOf(points));
  }

  /** \brief The first of its scans, whose descriptors say little, comes last. */
  static const made::HallScans&
  hall()
  {
    static const made::HallScans hall = [] {
      made::HallScans made(true, 10000);
      std::rotate(made.scans.begin(), made.scans.begin() + 1, made.scans.end());
      std::rotate(made.T_hall_scan.begin(),
                  made.T_hall_scan.begin() + 1,
                  made.T_hall_scan.end());
      return made;
    }();
    return hall;
  }

  void
  writeScan(const std::string& name, std::size_t number) const
  {
    fs::create_directories(fs::path(path(name)).parent_path());
    io::writeCloud(path(name), cloudOf(hall().scans[number]));
  }

  /** \brief As scans/scan_N.pcd. */
  void
  writeScans(std::size_t from, std::size_t to) const
  {
    for (std::size_t i = from; i < to; ++i)
      writeScan("scans/scan_" + std::to_string(i) + ".pcd", i);
  }

  /** \brief Runs the program in the folder.
   * \param[in] arguments as they are typed into a shell */
  ProgramRun
  localize(const std::string& arguments) const
  {
    return runProgram(PCL_FLASHREG_LOCALIZE, arguments);
  }

  /** \brief Of standard output, each an object by itself. */
  static Lines
  linesOf(const ProgramRun& run)
  {
    Lines lines;
    std::istringstream text(run.out);
    for (std::string line; std::getline(text, line);)
      lines.push_back(nlohmann::json::parse(line));
    return lines;
  }

  /** \brief Standard output without times, which alone differ from run to run. */
  static std::string
  untimed(const ProgramRun& run)
  {
    std::string text;
    std::istringstream lines(run.out);
    for (std::string line; std::getline(lines, line);) {
      const std::size_t times = line.find(",\"timings_ms\":");
      EXPECT_NE(times, std::string::npos) << line;
      text += line.substr(0, times) + '\n';
    }
    return text;
  }

  static Eigen::Isometry3d
  poseOf(const nlohmann::json& line)
  {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        pose.matrix()(i, j) = line.at("transformation")
                                  .at(static_cast<std::size_t>(i))
                                  .at(static_cast<std::size_t>(j));
    return pose;
  }

  /** \brief How far a pose of a scan in the map is off, in metres, a few metres away.
   */
  static double
  errorOf(const Eigen::Isometry3d& T_map_scan, std::size_t number)
  {
    const Eigen::Vector3d far(2, 2, 1);
    return (T_map_scan * far - hall().T_hall_scan[number] * far).norm();
  }

  void
  expectFound(const nlohmann::json& line, std::size_t number) const
  {
    EXPECT_EQ(line.at("converged"), true) << line;
    EXPECT_LT(errorOf(poseOf(line), number), 0.05) << line;
  }

  void
  expectFailure(const std::string& arguments, int status, const std::string& why) const
  {
    const ProgramRun run = localize(arguments);
    EXPECT_EQ(run.status, status) << arguments << '\n' << run.err;
    EXPECT_EQ(run.out, "") << arguments;
    EXPECT_EQ(run.err.find("pcl_flashreg_localize: error: "), 0u) << run.err;
    EXPECT_NE(run.err.find(why), std::string::npos) << run.err;
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  }
};

} // namespace pcl_flashreg::localize
