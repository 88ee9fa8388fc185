// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_map on bad scans and bad options: one clear line, and nothing is lost.

#include "cli_map_support.h"

#include <limits>

namespace pcl_flashreg::map {
namespace {

class CliMapInput : public MapTest {
protected:
  void
  writeBadScans() const
  {
    write("scans/cut.pcd", "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\n");
    write("scans/empty.pcd", "");
    write("scans/garbage.ply", "no cloud at all");
    const Eigen::Vector3d nowhere =
        Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    io::writeCloud(path("scans/nan.pcd"),
                   cloudOf({nowhere, nowhere, nowhere, nowhere}));
    io::writeCloud(path("scans/two.pcd"), cloudOf({{0, 0, 0}, {1, 0, 0}}));
    io::writeCloud(
        path("scans/near.pcd"),
        cloudOf({{0.01, 0, 0}, {0.02, 0, 0}, {0.03, 0, 0}, {0.02, 0.01, 0}}));
    fs::copy_file(path("scans/scan_1.pcd"), path("scans/scan_10.pcd"));
  }
};

TEST_F(CliMapInput, leavesBadScansOut)
{
  writeScans(0, 3);
  writeBadScans();
  write("scans/notes.txt", "not a cloud");
  write("scans/.hidden.pcd", "not a cloud");
  const ProgramRun run = makeMap("scans map.pcd --json r.json" + std::string(LEAF));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out.find("all 3 scans are placed, in one map\n"), 0u) << run.out;
  for (const char* text :
       {"note: scans/cut.pcd: ",
        "note: scans/empty.pcd: is empty; it is left out",
        "note: scans/garbage.ply: ",
        "note: scans/nan.pcd: none of its 4 points have finite coordinates; it is",
        "note: scans/two.pcd: only 2 of its 2 points have finite coordinates",
        "note: scans/near.pcd: only 0 points are left at a resolution of 0.1",
        "note: scans/scan_10.pcd: is the same as scans/scan_1.pcd; it is left out"})
    EXPECT_NE(run.err.find(text), std::string::npos) << text << '\n' << run.err;
  EXPECT_NE(run.out.find("\nleft out    scans/empty.pcd: is empty\n"),
            std::string::npos)
      << run.out;
  EXPECT_EQ(nlohmann::json::parse(read("r.json")).at("left_out").size(), 7u);
  EXPECT_EQ(run.err.find("notes.txt"), std::string::npos);
  EXPECT_EQ(run.err.find("hidden"), std::string::npos);
}

TEST_F(CliMapInput, leavesBadScansOutOfTheEstimateToo)
{
  writeScans(0, 2);
  ASSERT_EQ(makeMap("scans --json good.json").status, 0);
  writeBadScans();
  fs::remove(path("scans/near.pcd"));
  ASSERT_EQ(makeMap("scans --json r.json").status, 0);
  EXPECT_EQ(nlohmann::json::parse(read("r.json")).at("resolution"),
            nlohmann::json::parse(read("good.json")).at("resolution"));
}

TEST_F(CliMapInput, strictEndsAtABadScan)
{
  writeScans(0, 2);
  write("scans/empty.pcd", "");
  expectFailure(
      "scans --strict --quiet --leaf 0.1", 3, "error: scans/empty.pcd: is empty\n");
  expectFailure("scans --strict --quiet", 3, "error: scans/empty.pcd: is empty\n");
}

TEST_F(CliMapInput, needsTwoScans)
{
  writeScans(0, 1);
  expectFailure(
      "scans --leaf 0.1 --quiet", 3, "a map needs two scans, there is one that can be");
  expectFailure("scans nosuch.pcd -o m.pcd --quiet",
                3,
                "there is one that can be used; nosuch.pcd: no such file");
  fs::create_directories(path("none"));
  expectFailure("none m.pcd", 3, "none: holds no cloud (.pcd, .ply, .bin)");
  write("list.txt", "# nothing\n");
  expectFailure("--list list.txt", 3, "list.txt: names no scan");
  expectFailure("--list nosuch.txt", 3, "nosuch.txt: no such file");
}

TEST_F(CliMapInput, aScanGivenTwiceIsAnError)
{
  writeScans(0, 2);
  expectFailure(
      "scans scans/scan_1.pcd -o map.pcd", 2, "scans/scan_1.pcd: is given twice");
  expectFailure(
      "scans/scan_0.pcd scans/../scans/scan_0.pcd -o map.pcd", 2, "is given twice");
}

TEST_F(CliMapInput, namesTellScansApart)
{
  writeScans(0, 2);
  fs::create_directories(path("more"));
  io::writeCloud(path("more/scan_1.pcd"), madeScan(2).cloud);
  ASSERT_EQ(makeMap("scans more --poses p.csv" + std::string(LEAF)).status, 2)
      << "more is no map";
  ASSERT_EQ(makeMap("scans more -o map.pcd --poses p.csv" + std::string(LEAF)).status,
            0);
  for (const char* name :
       {"\nscan_0.pcd,", "\nscans/scan_1.pcd,", "\nmore/scan_1.pcd,"})
    EXPECT_NE(read("p.csv").find(name), std::string::npos) << read("p.csv");
  // By no more of the path than it takes.
  ASSERT_EQ(makeMap(path("scans") + " " + path("more") + " -o map.pcd --poses q.csv" +
                    LEAF + " --pairs q.pairs.csv")
                .status,
            0);
  EXPECT_EQ(read("p.csv"), read("q.csv"));
}

TEST_F(CliMapInput, readsRawScans)
{
  fs::create_directories(path("scans"));
  for (std::size_t i = 0; i < 2; ++i) {
    const io::Cloud cloud = madeScan(i).cloud;
    write("scans/" + std::to_string(i) + ".bin",
          std::string(reinterpret_cast<const char*>(cloud.data.data()),
                      cloud.data.size()));
  }
  const ProgramRun run =
      makeMap("scans map.pcd --bin-fields 4 --no-viewpoint" + std::string(LEAF));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(io::readCloud(path("map.pcd")).find("intensity"), nullptr);
}

TEST_F(CliMapInput, aScanIsNeverTakenForTheMap)
{
  writeScans(0, 3);
  const std::string first = read("scans/scan_2.pcd");
  expectFailure("scans/scan_0.pcd scans/scan_1.pcd scans/scan_2.pcd",
                2,
                "scans/scan_2.pcd: is there already: if it is the map to be written");
  expectFailure(
      "scans scans/scan_2.pcd", 2, "would be overwritten, but it is an input");
  expectFailure("scans scans/new.pcd", 2, "lies in the folder of the scans");
  write("a_2.pcd", first);
  expectFailure("scans a_2.pcd a.pcd --poses p.csv", 2, "would be overwritten");
  expectFailure("scans/scan_0.pcd x.bin", 2, "x.bin: is no path for the map");
  EXPECT_EQ(read("scans/scan_2.pcd"), first);
  EXPECT_EQ(read("a_2.pcd"), first);
}

TEST_F(CliMapInput, refusesOutputsBeforeTheWork)
{
  writeScans(0, 2);
  expectFailure("scans nowhere/map.pcd", 2, "the folder ");
  expectFailure("scans map.xyz", 2, "map.xyz: is no path for the map");
  expectFailure("scans -o map.xyz", 2, "map.xyz: clouds are written as .pcd or .ply");
  expectFailure("scans map.pcd --json map.pcd", 2, "two outputs go to the same file");
  expectFailure("scans --poses p.xml", 2, "p.xml: poses are written as .tum");
  expectFailure("scans --poses p", 2, "p: poses are written as .tum");
  expectFailure("scans --poses scans", 2, "poses are written as");
  expectFailure("scans --graph scans", 2, "scans: is a directory, not a file");
  EXPECT_FALSE(fs::exists(path("map.pairs.csv")));
}

TEST_F(CliMapInput, refusesOptions)
{
  writeScans(0, 2);
  expectFailure("", 2, "a folder of scans is needed");
  expectFailure("scans --nosuch", 2, "--help lists the options");
  expectFailure("scans --leaf 0", 2, "--leaf: the voxel size must be a length > 0");
  expectFailure("scans m.pcd --map-leaf -1", 2, "--map-leaf: the voxel size");
  expectFailure("scans --min-confidence 1", 2, "--min-confidence: must lie between");
  expectFailure("scans --min-confidence nan", 2, "--min-confidence: must lie between");
  expectFailure("scans --bin-fields 2", 2, "--bin-fields");
  expectFailure(
      "scans --gravity 0,0,1", 2, "--gravity: says nothing without --upright");
  expectFailure("scans --upright --gravity 0,0", 2, "--gravity: expected a direction");
  expectFailure("scans --upright --max-tilt 31", 2, "--max-tilt = 31 is out of range");
  expectFailure("scans --format xml --poses p", 2, "--format");
  expectFailure("scans --shard 3/2 --pairs p", 2, "--shard: expected i/n");
  expectFailure("scans --shard 1/2", 2, "need an output, or --pairs");
  expectFailure("scans --resume", 2, "need an output, or --pairs");
  expectFailure("scans --add --json -", 2, "need an output, or --pairs");
}

TEST_F(CliMapInput, helpAndVersion)
{
  EXPECT_EQ(makeMap("--help").status, 0);
  EXPECT_EQ(makeMap("--version").out.find("pcl_flashreg_map "), 0u);
}

} // namespace
} // namespace pcl_flashreg::map
