// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_localize on bad maps, indices, scans and options: one clear line, and
// what can be done is done.

#include "cli_localize_support.h"

#include <cmath>

namespace pcl_flashreg::localize {
namespace {

class CliLocalizeInput : public LocalizeTest {
protected:
  void
  SetUp() override
  {
    LocalizeTest::SetUp();
    writeScans(0, 2);
  }
};

TEST_F(CliLocalizeInput, aBrokenScanIsToldAndTheOthersGoOn)
{
  write("broken.pcd", "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n");
  io::writeCloud(path("few.pcd"), cloudOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  const ProgramRun run =
      localize("map.pcd scans/scan_0.pcd broken.pcd few.pcd nosuch.pcd "
               "scans/scan_1.pcd" +
               std::string(LEAF));
  EXPECT_EQ(run.status, 3);
  const Lines lines = linesOf(run);
  ASSERT_EQ(lines.size(), 5u);
  expectFound(lines[0], 0);
  expectFound(lines[4], 1);
  for (const std::size_t i : {1u, 2u, 3u}) {
    const std::string error = lines[i].at("error");
    EXPECT_EQ(lines[i].at("converged"), false);
    EXPECT_EQ(error.find(std::string(lines[i].at("file")) + ": "), 0u) << error;
    EXPECT_NE(run.err.find("pcl_flashreg_localize: error: " + error + '\n'),
              std::string::npos)
        << run.err;
  }
  EXPECT_NE(run.err.find("2 of 5 placed, 3 not usable, median "), std::string::npos)
      << run.err;
}

TEST_F(CliLocalizeInput, theFirstUsableScanTellsTheResolution)
{
  write("broken.pcd", "no cloud");
  const ProgramRun run = localize("map.pcd broken.pcd scans/scan_0.pcd");
  EXPECT_EQ(run.status, 3);
  expectFound(linesOf(run).at(1), 0);
  expectFailure("map.pcd broken.pcd", 3, "no scan can be used to tell a resolution: ");
}

TEST_F(CliLocalizeInput, badMapsAreErrors)
{
  const std::string scan = " scans/scan_0.pcd --quiet" + std::string(LEAF);
  write("empty.pcd", "");
  io::writeCloud(path("far.pcd"),
                 cloudOf({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}}));
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(std::nan(""));
  io::writeCloud(path("nan.pcd"), cloudOf({nowhere, nowhere, nowhere}));
  expectFailure("scans" + scan, 2, "scans: is a folder: pcl_flashreg_map makes a map");
  expectFailure("nosuch.pcd" + scan, 3, "nosuch.pcd: no such file");
  expectFailure("empty.pcd" + scan, 3, "empty.pcd: is empty");
  expectFailure("nan.pcd" + scan, 3, "nan.pcd: none of its 3 points have finite");
  expectFailure("far.pcd" + scan, 3, "far.pcd: the voxel grid of 0.1 leaves no point");
}

TEST_F(CliLocalizeInput, anIndexOfAnotherMapIsRefused)
{
  const std::string scan = " scans/scan_0.pcd --quiet";
  ASSERT_EQ(localize("map.pcd --index map.index" + scan + LEAF).status, 0);
  const std::string index = read("map.index");
  writeMap("other.pcd", 1);
  expectFailure("other.pcd --index map.index" + scan, 2, "map.index: was made of /");
  expectFailure("map.pcd --index map.index --leaf 0.2" + scan,
                2,
                "--leaf 0.2: map.index was made at 0.1");
  expectFailure("map.index --leaf 0.2" + scan, 2, "map.index was made at 0.1");
  expectFailure(
      "map.index --index more.index" + scan, 2, "map.index is an index already");
  fs::rename(path("map.index.json"), path("kept.json"));
  expectFailure("map.pcd --index map.index" + scan,
                2,
                "map.index.json does not tell what it was made of");
  EXPECT_EQ(read("map.index"), index);
  // The stamp of another index.
  ASSERT_EQ(localize("map.pcd --index map2.index --leaf 0.15" + scan).status, 0);
  fs::rename(path("map2.index.json"), path("map.index.json"));
  expectFailure("map.pcd --index map.index" + scan, 2, "does not tell what it was");
}

TEST_F(CliLocalizeInput, damagedIndicesAreErrors)
{
  const std::string scan = " scans/scan_0.pcd --quiet";
  ASSERT_EQ(localize("map.pcd --index map.index" + scan + LEAF).status, 0);
  std::string index = read("map.index");
  write("cut.index", index.substr(0, index.size() / 2));
  expectFailure("cut.index" + scan, 3, "cut.index: is incomplete");
  index[index.size() / 2] = static_cast<char>(index[index.size() / 2] ^ 1);
  write("map.index", index);
  expectFailure("map.index --verify" + scan, 3, "map.index: is damaged");
  expectFailure("map.pcd --index map.index --verify" + scan,
                3,
                "; once it is removed, it is made again");
  write("text.index", "no index");
  expectFailure("map.pcd --index text.index" + scan,
                3,
                "text.index: is there already, and is no index");
  EXPECT_EQ(read("text.index"), "no index");
  // As a scan it is an error, too.
  EXPECT_EQ(
      linesOf(localize("map.pcd map.index" + std::string(LEAF))).at(0).at("error"),
      "map.index: is an index, not a scan");
}

TEST_F(CliLocalizeInput, refusesOptions)
{
  const std::string run = "map.pcd scans/scan_0.pcd ";
  expectFailure("", 2, "a map and a scan are needed");
  expectFailure("map.pcd", 2, "a map and a scan are needed");
  expectFailure(run + "--nosuch", 2, "--help lists the options");
  expectFailure(run + "--leaf 0", 2, "--leaf: the voxel size must be a length > 0");
  expectFailure(run + "--near 1,2,3,0", 2, "--near: the radius R must be > 0");
  expectFailure(run + "--near 1,2,3,-1", 2, "--near: the radius R must be > 0");
  expectFailure(run + "--near 1,2,3", 2, "--near: expected X,Y,Z,R, found '1,2,3'");
  expectFailure(run + "--near here", 2, "--near: expected X,Y,Z,R");
  expectFailure(run + "--guess 1,2", 2, "--guess: expected X,Y,Z");
  expectFailure(run + "--guess 1,2,3,0,0,0,2", 2, "must have length 1");
  expectFailure(run + "--guess nosuch.txt", 3, "nosuch.txt: no such file");
  expectFailure(run + "--min-confidence 2", 2, "--min-confidence = 2 is");
  expectFailure(run + "--gravity 0,0,1", 2, "--gravity: says nothing without");
  expectFailure(run + "--gravity-map 0,0,1", 2, "--gravity-map: says nothing without");
  expectFailure(run + "--poses p.xml", 2, "p.xml: poses are written as .tum");
  expectFailure(run + "--poses map.pcd --format tum", 2, "but it is an input");
  expectFailure(run + "--index map.pcd", 2, "but it is an input");
  expectFailure(run + "--index nowhere/map.index", 2, "the folder ");
  expectFailure(run + "scans/scan_0.pcd", 2, "is given twice");
}

TEST_F(CliLocalizeInput, helpAndVersion)
{
  EXPECT_EQ(localize("--help").status, 0);
  EXPECT_EQ(localize("--version").out.find("pcl_flashreg_localize "), 0u);
}

} // namespace
} // namespace pcl_flashreg::localize
