// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_map however it is run, or was ended: the same poses to the last byte.

#include "cli_map_support.h"
#include "support/ranks.h"

namespace pcl_flashreg::map {
namespace {

/** \brief Six scans, and what one plain run makes of them. */
class CliMapRuns : public MapTest {
protected:
  void
  SetUp() override
  {
    MapTest::SetUp();
    writeScans(0, SCANS);
    ASSERT_EQ(makeMap("scans --poses whole.csv" + std::string(LEAF)).status, 0);
    poses_ = read("whole.csv");
    pairs_ = read("whole.pairs.csv");
  }

  /** \brief Ends well, and has the same poses, and the same file of pairs in the end. */
  void
  expectSame(const std::string& arguments, const std::string& launcher = "") const
  {
    const ProgramRun run =
        makeMap(arguments + " --poses p.csv --pairs pairs.csv" + LEAF, launcher);
    EXPECT_EQ(run.status, 0) << arguments << '\n' << run.err;
    EXPECT_EQ(read("p.csv"), poses_) << arguments;
    EXPECT_EQ(read("pairs.csv"), pairs_) << arguments;
  }

  /** \brief Nothing but the scans and what was asked for is left. */
  void
  expectNoParts() const
  {
    for (const auto& entry : fs::directory_iterator(path()))
      for (const char* part : {".rank", ".shard"})
        EXPECT_EQ(entry.path().string().find(part), std::string::npos) << entry.path();
  }

  static constexpr std::size_t SCANS = 6, PAIRS = 15;

  std::string poses_, pairs_;
};

TEST_F(CliMapRuns, anyOrderOfTheScans)
{
  expectSame("scans/scan_3.pcd scans/scan_1.pcd scans/scan_5.pcd scans/scan_0.pcd "
             "scans/scan_4.pcd scans/scan_2.pcd -o map.pcd");
}

TEST_F(CliMapRuns, aList)
{
  write("lists/all.txt",
        "# of the scans\n../scans/scan_5.pcd\n\n  ../scans/scan_0.pcd # first\n"
        "../scans/scan_4.pcd\r\n../scans/scan_1.pcd\n../scans/scan_2.pcd\n"
        "../scans/scan_3.pcd");
  expectSame("--list lists/all.txt");
}

TEST_F(CliMapRuns, anyNumberOfThreads)
{
  expectSame("scans --threads 1");
  fs::remove(path("pairs.csv"));
  expectSame("scans --threads 3");
}

TEST_F(CliMapRuns, scansInAFolder)
{
  expectSame("scans --low-memory kept");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("kept")), {}),
            static_cast<std::ptrdiff_t>(SCANS));
  fs::remove(path("pairs.csv"));
  // One is damaged, the others are taken.
  const fs::path damaged = fs::directory_iterator(path("kept"))->path();
  fs::resize_file(damaged, fs::file_size(damaged) - 1);
  expectSame("scans --low-memory kept");
}

TEST_F(CliMapRuns, goOnWhereverTheyWereKilled)
{
  const std::size_t header = pairs_.find('\n', pairs_.find('\n') + 1) + 1;
  for (const std::size_t size :
       {header, header + 1, header + (pairs_.size() - header) / 2, pairs_.size() - 1}) {
    write("pairs.csv", pairs_.substr(0, size));
    expectSame("scans --resume");
  }
  expectSame("scans --resume");
}

TEST_F(CliMapRuns, whatIsKnownIsNotComputedAgain)
{
  // A false pose in the place of a true one is believed.
  const std::size_t last = pairs_.rfind('\n', pairs_.size() - 2) + 1;
  write("pairs.csv", pairs_.substr(0, last) + "4,5,0,\n");
  const ProgramRun run =
      makeMap("scans --poses p.csv --pairs pairs.csv --resume" + std::string(LEAF));
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.out.find("15 registered, 15 of them by earlier runs\n"),
            std::string::npos)
      << run.out;
  EXPECT_NE(read("p.csv"), poses_);
}

TEST_F(CliMapRuns, takeScansIn)
{
  fs::create_directories(path("later"));
  for (const char* scan : {"scan_2.pcd", "scan_5.pcd"})
    fs::rename(path("scans/" + std::string(scan)), path("later/" + std::string(scan)));
  ASSERT_EQ(makeMap("scans --poses p.csv --pairs pairs.csv" + std::string(LEAF)).status,
            0);
  for (const char* scan : {"scan_2.pcd", "scan_5.pcd"})
    fs::rename(path("later/" + std::string(scan)), path("scans/" + std::string(scan)));
  expectFailure(
      "scans --poses p.csv --pairs pairs.csv --resume --leaf 0.1 --quiet",
      3,
      "pairs.csv: was made of other scans: scan_2.pcd is new (--add takes new "
      "scans in)");
  const ProgramRun run =
      makeMap("scans --poses p.csv --pairs pairs.csv --add" + std::string(LEAF));
  EXPECT_NE(run.out.find("15 registered, 6 of them by earlier runs\n"),
            std::string::npos)
      << run.out;
  EXPECT_EQ(read("p.csv"), poses_);
  EXPECT_EQ(read("pairs.csv"), pairs_);
}

TEST_F(CliMapRuns, knowScansByWhatIsInThem)
{
  write("pairs.csv", pairs_);
  fs::rename(path("scans/scan_5.pcd"), path("scans/scan_5b.pcd"));
  ProgramRun run =
      makeMap("scans --poses p.csv --pairs pairs.csv --resume" + std::string(LEAF));
  EXPECT_NE(run.out.find("15 of them by earlier runs"), std::string::npos) << run.err;
  // What comes first now was last: its pairs have changed places.
  fs::rename(path("scans/scan_5b.pcd"), path("scans/a.pcd"));
  run = makeMap("scans --poses p.csv --pairs pairs.csv --resume" + std::string(LEAF));
  EXPECT_NE(run.out.find("10 of them by earlier runs"), std::string::npos) << run.err;
  fs::remove(path("pairs.csv"));
  const std::string poses = read("p.csv");
  ASSERT_EQ(makeMap("scans --poses p.csv --pairs pairs.csv" + std::string(LEAF)).status,
            0);
  EXPECT_EQ(read("p.csv"), poses);
}

TEST_F(CliMapRuns, refuseWhatOthersMade)
{
  write("pairs.csv", pairs_);
  const std::string run = "scans --poses p.csv --pairs pairs.csv --quiet --resume ";
  expectFailure(run + "--leaf 0.2",
                3,
                "pairs.csv: was made with other settings: leaf was 0.1, is 0.2");
  expectFailure(run + "--no-viewpoint", 3, "viewpoints was true, is false");
  expectFailure(run + "--upright", 3, "was made with other settings: upright");
  fs::rename(path("scans/scan_3.pcd"), path("scan_3.pcd"));
  expectFailure(run + "--add", 3, "scan_3.pcd is not among the scans now");
  io::writeCloud(path("scans/scan_3.pcd"), madeScan(7).cloud);
  expectFailure(run, 3, "scan_3.pcd has changed since");
  write("pairs.csv", "name,group\n");
  expectFailure(run, 3, "pairs.csv: line 1: is not the configuration");
  const std::size_t header = pairs_.find('\n', pairs_.find('\n') + 1) + 1;
  for (const char* row :
       {"1,1,0,\n", "0,6,0,\n", "0,1,0\n", "0,1,2,\n", "0,1,0,1 2 3\n"}) {
    write("pairs.csv", pairs_.substr(0, header) + row);
    expectFailure(run, 3, "pairs.csv: line 3: ");
  }
}

TEST_F(CliMapRuns, theResolutionIsTheFiles)
{
  write("pairs.csv", pairs_);
  const ProgramRun run = makeMap("scans --poses p.csv --pairs pairs.csv --resume");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read("p.csv"), poses_);
}

TEST_F(CliMapRuns, keepAFileThatIsThere)
{
  write("pairs.csv", pairs_);
  expectFailure("scans --poses p.csv --pairs pairs.csv",
                2,
                "pairs.csv is there already: --resume goes on with it");
  EXPECT_EQ(read("pairs.csv"), pairs_);
}

TEST_F(CliMapRuns, shardsMakeTheWhole)
{
  const std::string shard = "scans --poses p.csv --pairs pairs.csv --leaf 0.1 --shard ";
  for (const char* part : {"2/3", "1/3", "3/3"}) {
    const ProgramRun run = makeMap(shard + part);
    EXPECT_EQ(run.status, 0) << run.err;
    EXPECT_EQ(run.out, "");
  }
  EXPECT_FALSE(fs::exists(path("p.csv")));
  expectFailure(shard + "2/3", 2, "pairs.csv.shard2 is there already");
  // One was killed, and goes on; the others stay as they are.
  const std::string rows = read("pairs.csv.shard2");
  write("pairs.csv.shard2", rows.substr(0, rows.size() - 10));
  EXPECT_EQ(makeMap(shard + "2/3 --resume").status, 0);
  EXPECT_EQ(read("pairs.csv.shard2"), rows);
  expectFailure("scans --poses p.csv --pairs pairs.csv --leaf 0.1",
                2,
                "is there already: --resume goes on with it");
  expectSame("scans --resume");
  expectNoParts();
}

class CliMapRanks : public CliMapRuns {
protected:
  void
  SetUp() override
  {
#ifndef PCL_FLASHREG_MPIEXEC
    GTEST_SKIP() << "built without MPI, or there is no mpirun";
#endif
    CliMapRuns::SetUp();
  }
};

TEST_F(CliMapRanks, makeTheSame)
{
  expectSame("scans --threads 1", onRanks(4));
  expectNoParts();
}

TEST_F(CliMapRanks, goOnFromTheirParts)
{
  const std::size_t header = pairs_.find('\n', pairs_.find('\n') + 1) + 1,
                    row = pairs_.find('\n', header) + 1;
  write("pairs.csv.rank0", pairs_.substr(0, row));
  write("pairs.csv.rank2", pairs_.substr(0, header) + pairs_.substr(row, 100));
  expectSame("scans --threads 1 --resume", onRanks(2));
  expectNoParts();
}

TEST_F(CliMapRanks, failTogether)
{
  EXPECT_NE(makeMap("scans --leaf 0.1", onRanks(2)).status, 0) << "without --pairs";
  write("pairs.csv", pairs_);
  EXPECT_NE(makeMap("scans --leaf 0.1 --pairs pairs.csv", onRanks(2)).status, 0);
}

} // namespace
} // namespace pcl_flashreg::map
