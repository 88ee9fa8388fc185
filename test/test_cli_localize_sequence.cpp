// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_localize --sequence, in a map that has the same hall twice.

#include "cli_localize_support.h"
#include "io/pose_io.h"
#include "support/twin_halls.h"

namespace pcl_flashreg::localize {
namespace {

using made::TwinHalls;

bool
contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

class CliLocalizeSequence : public LocalizeTest {
protected:
  static constexpr const char* SCANS =
      " scans/0.pcd scans/1.pcd scans/2.pcd scans/3.pcd";

  void
  SetUp() override
  {
    ProgramTest::SetUp();
    io::writeCloud(path("map.pcd"), cloudOf(halls().map));
    fs::create_directories(path("scans"));
    for (std::size_t i = 0; i < halls().scans.size(); ++i)
      io::writeCloud(path("scans/" + std::to_string(i) + ".pcd"),
                     cloudOf(halls().scans[i]));
    write("odometry.tum", io::formatTum(posed()));
  }

  static const TwinHalls&
  halls()
  {
    static const TwinHalls halls;
    return halls;
  }

  static std::vector<io::PosedScan>
  posed()
  {
    std::vector<io::PosedScan> scans;
    for (const RigidTransform& pose : halls().odometry()) {
      const std::string number = std::to_string(scans.size());
      scans.push_back({number, number, pose});
    }
    return scans;
  }

  static RigidTransform
  transformOf(const nlohmann::json& line)
  {
    const Eigen::Isometry3d T = poseOf(line);
    return {T.linear(), T.translation()};
  }

  static void
  expectAllFound(const Lines& lines)
  {
    ASSERT_EQ(lines.size(), 5u);
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(lines[i].at("converged"), true) << lines[i];
      EXPECT_LT(halls().errorOf(transformOf(lines[i]), i), 0.05) << lines[i];
    }
  }
};

TEST_F(CliLocalizeSequence, findsTogetherWhatIsAmbiguousAlone)
{
  const std::string arguments =
      "map.pcd" + std::string(SCANS) + " --sequence odometry.tum" + LEAF;
  const ProgramRun run = localize(arguments + " --poses poses.tum");
  EXPECT_EQ(run.status, 0) << run.err;
  const Lines lines = linesOf(run);
  expectAllFound(lines);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lines[i].at("alone").at("converged"), false) << lines[i];
    EXPECT_GT(lines[i].at("alone").at("rivals").size(), 0u) << lines[i];
    EXPECT_GT(lines[i].at("matched"), 0.5) << lines[i];
  }
  const nlohmann::json& sequence = lines[4];
  EXPECT_EQ(sequence.at("sequence"), "odometry.tum");
  EXPECT_EQ(sequence.at("scans"), 4);
  EXPECT_EQ(sequence.at("converged"), true);
  EXPECT_EQ(sequence.at("confidence"), lines[0].at("confidence"));
  EXPECT_EQ(sequence.at("supporters"), 4);
  EXPECT_TRUE(sequence.at("evidence").at("in_map"));
  EXPECT_GT(sequence.at("timings_ms").at("placing"), 0);
  const Eigen::Isometry3d first = poseOf(sequence) * halls().odometry()[0].toIsometry();
  EXPECT_LT(halls().errorOf({first.linear(), first.translation()}, 0), 0.05);
  EXPECT_TRUE(contains(run.err, "odometry.tum: sequence of 4 scans: at (")) << run.err;
  EXPECT_TRUE(contains(run.err, "\n4 of 4 placed, median ")) << run.err;

  // What it writes it reads.
  const std::vector<io::NumberedPose> poses = io::parsePoses(read("poses.tum"));
  ASSERT_EQ(poses.size(), 4u);
  EXPECT_LT(halls().errorOf(poses[2].pose, 2), 0.05);
  EXPECT_EQ(untimed(localize(arguments + " --threads 1")), untimed(run));
}

TEST_F(CliLocalizeSequence, scansOfTwinHallsAreNotTrusted)
{
  const ProgramRun run = localize(
      "map.pcd scans/0.pcd scans/1.pcd --sequence odometry.tum" + std::string(LEAF));
  EXPECT_EQ(run.status, 1) << run.err;
  const Lines lines = linesOf(run);
  ASSERT_EQ(lines.size(), 3u);
  for (const nlohmann::json& line : lines)
    EXPECT_EQ(line.at("converged"), false) << line;
  ASSERT_GT(lines[2].at("rivals").size(), 0u) << lines[2];
  EXPECT_GT(lines[2].at("rivals").at(0).at("supporters"), 0);
  EXPECT_TRUE(contains(run.err, "sequence of 2 scans: not found: best guess ("))
      << run.err;
  EXPECT_TRUE(contains(run.err, " rival")) << run.err;
}

TEST_F(CliLocalizeSequence, aBrokenScanIsToldAndTheOthersGoOn)
{
  write("scans/1.pcd", "no cloud");
  const ProgramRun run =
      localize("map.pcd" + std::string(SCANS) + " --sequence odometry.tum" + LEAF);
  EXPECT_EQ(run.status, 3);
  const Lines lines = linesOf(run);
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_TRUE(lines[1].contains("error"));
  EXPECT_EQ(lines[4].at("scans"), 3);
  EXPECT_LT(halls().errorOf(transformOf(lines[0]), 0), 0.05) << run.err;
}

TEST_F(CliLocalizeSequence, nearAPlaceNothingElseIsTrusted)
{
  const std::string arguments =
      "map.pcd scans/0.pcd scans/1.pcd --sequence odometry.tum --near ";
  const Eigen::Vector3d at = halls().T_map_scan[0].translation();
  std::ostringstream here;
  here << at.x() << ',' << at.y() << ',' << at.z();
  const ProgramRun in = localize(arguments + here.str() + ",5" + LEAF);
  EXPECT_EQ(in.status, 0) << in.err;
  EXPECT_LT(halls().errorOf(transformOf(linesOf(in).at(0)), 0), 0.05) << in.err;
  // The second scan was made farther away.
  const ProgramRun out = localize(arguments + here.str() + ",0.5" + LEAF);
  EXPECT_EQ(out.status, 1) << out.err;
  EXPECT_TRUE(contains(out.err, " away from the place of --near, where 0.5 is allowed"))
      << out.err;
}

TEST_F(CliLocalizeSequence, aGuessIsOfTheSequence)
{
  const Eigen::Isometry3d T =
      halls().T_map_scan[0] * halls().odometry()[0].toIsometry().inverse();
  std::ostringstream matrix;
  matrix << T.matrix() << '\n';
  write("guess.txt", matrix.str());
  const ProgramRun run = localize("map.pcd" + std::string(SCANS) +
                                  " --sequence odometry.tum --guess guess.txt" + LEAF);
  EXPECT_EQ(run.status, 0) << run.err;
  expectAllFound(linesOf(run));
}

TEST_F(CliLocalizeSequence, posesAreInEitherFormatAndByNumber)
{
  write("odometry.kitti", io::formatKitti(posed()));
  const std::string run = "map.pcd scans/3.pcd scans/2.pcd --quiet" + std::string(LEAF);
  std::vector<io::PosedScan> swapped = posed();
  std::swap(swapped[0], swapped[3]);
  write("swapped.tum", io::formatTum(swapped));
  const std::string by_number = untimed(localize(run + " --sequence odometry.tum"));
  const Lines lines = linesOf(localize(run + " --sequence swapped.tum"));
  ASSERT_EQ(lines.size(), 3u);
  EXPECT_LT(halls().errorOf(transformOf(lines[1]), 2), 0.05);
  EXPECT_TRUE(contains(by_number, "\"sequence\":\"odometry.tum\""));
  expectAllFound(linesOf(
      localize("map.pcd" + std::string(SCANS) + " --sequence odometry.kitti" + LEAF)));
}

TEST_F(CliLocalizeSequence, refusesWhatIsNoSequence)
{
  const std::string run = "map.pcd" + std::string(SCANS) + " --quiet";
  const auto refuse = [&](const std::string& text, const std::string& why) {
    write("bad.txt", text);
    expectFailure(run + " --sequence bad.txt", 3, "bad.txt: " + why);
  };
  expectFailure("map.pcd scans/0.pcd --sequence odometry.tum",
                2,
                "--sequence: a sequence has two scans or more");
  expectFailure(run + " --sequence nosuch.tum", 3, "nosuch.tum: no such file");
  expectFailure(
      run + " --sequence odometry.tum --poses odometry.tum", 2, "but it is an input");
  refuse("# none\n", "holds no rows of numbers");
  refuse("7 0 0 0 0 0 0 1\n8 1 0 0 0 0 0 1\n", "holds 2 poses, and there are 4 scans");
  refuse("0 0 0 0\n", "has rows of 4 numbers: poses have 8 (");
  refuse("0 0 0 0 0 0 0 1\n1 nan 0 0 0 0 0 1\n", "line 2: is no pose: ");
  refuse("nan 0 0 0 0 0 0 1\n", "line 1: is no pose: ");
  refuse("0 0 0 0 0 0 0 2\n", "line 1: is no pose: the quaternion must have length 1");
  refuse("1 0 0 0 0 2 0 0 0 0 1 0\n", "line 1: is no pose: the matrix must be");
  refuse("zero 0 0 0 0 0 0 1\n", "line 1: 'zero' is not a number");
}

} // namespace
} // namespace pcl_flashreg::localize
