// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_localize as a user runs it: what it finds, says and writes.

#include "cli_localize_support.h"
#include "io/text.h"

#include <pcl_flashreg/pair_registration.h>

namespace pcl_flashreg::localize {
namespace {

bool
contains(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

class CliLocalize : public LocalizeTest {};

TEST_F(CliLocalize, findsScansInTheOrderInWhichTheyAreGiven)
{
  writeScans(0, 3);
  const ProgramRun run =
      localize("map.pcd scans/scan_2.pcd scans/scan_0.pcd scans/scan_1.pcd");
  ASSERT_EQ(run.status, 0) << run.err;
  const Lines lines = linesOf(run);
  ASSERT_EQ(lines.size(), 3u);
  const std::size_t order[] = {2, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string name = "scan_" + std::to_string(order[i]) + ".pcd";
    EXPECT_EQ(lines[i].at("file"), "scans/" + name);
    expectFound(lines[i], order[i]);
    EXPECT_EQ(lines[i].at("status"), "ok");
    EXPECT_GT(lines[i].at("confidence"), 0.6);
    EXPECT_GT(lines[i].at("inliers"), 20);
    EXPECT_GT(lines[i].at("evidence").at("matched"), 0.5);
    EXPECT_EQ(lines[i].at("warnings"), nlohmann::json::array());
    EXPECT_GT(lines[i].at("timings_ms").at("total"), 0);
    EXPECT_TRUE(contains(run.err, name + ": at (")) << run.err;
  }
  EXPECT_TRUE(contains(run.err, ", heading ")) << run.err;
  EXPECT_TRUE(contains(run.err, "map.pcd: index made in ")) << run.err;
  EXPECT_TRUE(contains(run.err, "suits the scans; --leaf sets another")) << run.err;
  EXPECT_TRUE(contains(run.err, "\n3 of 3 placed, median ")) << run.err;
}

TEST_F(CliLocalize, writesThePoseInSeveralForms)
{
  writeScans(3, 4);
  const ProgramRun run = localize("map.pcd scans/scan_3.pcd" + std::string(LEAF));
  const nlohmann::json line = linesOf(run).at(0);
  const Eigen::Isometry3d pose = poseOf(line);
  const nlohmann::json &t = line.at("translation"), &q = line.at("quaternion");
  Eigen::Isometry3d same(Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
  same.pretranslate(Eigen::Vector3d(t[0], t[1], t[2]));
  EXPECT_TRUE(same.isApprox(pose, 1e-12));
  EXPECT_FALSE(contains(run.err, " placed, median ")) << "one scan has no total";
}

TEST_F(CliLocalize, anIndexIsMadeOnceAndFindsTheSame)
{
  writeScans(0, 2);
  const std::string arguments = "map.pcd scans --index map.index" + std::string(LEAF);
  const ProgramRun made = localize(arguments);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(contains(made.err, "index made in ")) << made.err;
  const std::string index = read("map.index"), stamp = read("map.index.json");

  const ProgramRun used = localize(arguments);
  EXPECT_TRUE(contains(used.err, "map.index: opened in ")) << used.err;
  EXPECT_FALSE(contains(used.err, "index made in ")) << used.err;
  EXPECT_EQ(untimed(used), untimed(made));
  // Its resolution is that of the index, which needs no estimate.
  EXPECT_EQ(untimed(localize("map.pcd scans --index map.index --verify")),
            untimed(made));
  EXPECT_EQ(untimed(localize("map.index scans")), untimed(made));
  EXPECT_EQ(read("map.index"), index);
  EXPECT_EQ(read("map.index.json"), stamp);

  // A copy of the map is the same map, whenever it was made.
  fs::copy_file(path("map.pcd"), path("copy.pcd"));
  EXPECT_EQ(untimed(localize("copy.pcd scans --index map.index")), untimed(made));
  EXPECT_EQ(read("map.index.json"), stamp);
}

TEST_F(CliLocalize, anIndexIsMadeAgainWhereItsMapHasChanged)
{
  writeScans(0, 1);
  const std::string arguments =
      "map.pcd scans/scan_0.pcd --index map.index" + std::string(LEAF);
  ASSERT_EQ(localize(arguments).status, 0);
  writeMap("map.pcd", 2);
  const ProgramRun run = localize(arguments);
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(contains(run.err,
                       "map.index: map.pcd has changed since it was made: it is made "
                       "again\n"))
      << run.err;
  const Eigen::Isometry3d back(Eigen::Translation3d(-2, 0, 0));
  EXPECT_LT(errorOf(back * poseOf(linesOf(run).at(0)), 0), 0.05);
  EXPECT_TRUE(contains(localize(arguments).err, "map.index: opened in "));

  // By another program, as its fingerprint tells.
  std::string stamp = read("map.index.json");
  stamp.replace(stamp.find("\"front_end\": \"") + 14, 4, "beef");
  write("map.index.json", stamp);
  EXPECT_TRUE(contains(localize(arguments).err, "another version of this program"));
}

TEST_F(CliLocalize, savedScansAreMapsAndScans)
{
  writeScans(0, 2);
  PairRegistration registration(BackendKind::Cpu, 1);
  const auto saved = [&](const std::string& from, const std::string& to, bool known) {
    const io::Cloud cloud = io::readCloud(path(from));
    const Eigen::Matrix3Xd xyz = io::coordinates(cloud);
    ScanInput<double> input;
    input.points = {xyz.data(), static_cast<std::size_t>(xyz.cols()), 3, nullptr, 0};
    input.viewpoint_known = known;
    registration.makeScan(input, 0.1).save(path(to));
  };
  saved("map.pcd", "map.scan", false);
  saved("scans/scan_0.pcd", "0.scan", true);
  const ProgramRun run = localize("map.scan 0.scan scans/scan_1.pcd");
  ASSERT_EQ(run.status, 0) << run.err;
  expectFound(linesOf(run).at(0), 0);
  expectFound(linesOf(run).at(1), 1);
  EXPECT_TRUE(
      contains(localize("map.pcd 0.scan --leaf 0.2").err,
               "0.scan: was saved at a resolution of 0.1, and is needed at 0.2"));
  expectFailure("map.scan 0.scan --leaf 0.2", 2, "map.scan was saved at 0.1");
}

TEST_F(CliLocalize, whatIsNotFoundIsNotTrusted)
{
  writeScans(0, 1);
  io::writeCloud(path("blob.pcd"), cloudOf(blobPoints()));
  const ProgramRun run =
      localize("map.pcd blob.pcd scans --poses p.csv" + std::string(LEAF));
  EXPECT_EQ(run.status, 1);
  const Lines lines = linesOf(run);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].at("converged"), false);
  expectFound(lines[1], 0);
  EXPECT_TRUE(contains(run.err, "blob.pcd: not found: ")) << run.err;
  EXPECT_TRUE(contains(run.err, "\n1 of 2 placed, median ")) << run.err;
  EXPECT_TRUE(contains(read("p.csv"), "\nblob.pcd,0,")) << read("p.csv");
  EXPECT_TRUE(contains(read("p.csv"), ",,,,,,\nscan_0.pcd,1,")) << read("p.csv");
}

TEST_F(CliLocalize, nearAPlaceTheRestOfTheMapDoesNotCount)
{
  writeScans(0, 2);
  const Eigen::Vector3d at = hall().T_hall_scan[0].translation();
  std::ostringstream here;
  here << " --near " << at.x() + 0.3 << ',' << at.y() << ',' << at.z() << ",0.5";
  const ProgramRun in = localize("map.pcd scans/scan_0.pcd" + here.str() + LEAF);
  EXPECT_EQ(in.status, 0) << in.err;
  expectFound(linesOf(in).at(0), 0);

  // The other scan was made 1.6 m away.
  const ProgramRun out = localize("map.pcd scans/scan_1.pcd" + here.str() + LEAF);
  EXPECT_EQ(out.status, 1);
  const nlohmann::json line = linesOf(out).at(0);
  EXPECT_EQ(line.at("converged"), false);
  EXPECT_TRUE(contains(line.at("warnings").at(0),
                       " away from the place of --near, where 0.5 is allowed"))
      << line;

  const ProgramRun nowhere =
      localize("map.pcd scans/scan_0.pcd --near -500,0,0,1" + std::string(LEAF));
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_TRUE(contains(nowhere.err, "the map has no points near the place of --near"));
}

TEST_F(CliLocalize, aGuessIsTriedWhetherTypedOrInAFile)
{
  const std::size_t last = SCANS - 1;
  writeScan("hard.pcd", last);
  const Eigen::Isometry3d truth = hall().T_hall_scan[last];
  const Eigen::Quaterniond q(truth.rotation());
  const Eigen::Vector3d t = truth.translation();
  std::ostringstream typed, matrix;
  typed << " --guess " << t.x() << ',' << t.y() << ',' << t.z() << ',' << q.x() << ','
        << q.y() << ',' << q.z() << ',' << q.w();
  matrix << truth.matrix() << '\n';
  write("guess.txt", matrix.str());
  for (const std::string& guess : {typed.str(), std::string(" --guess guess.txt")}) {
    const ProgramRun run = localize("map.pcd hard.pcd" + guess + LEAF);
    EXPECT_EQ(run.status, 0) << run.err;
    expectFound(linesOf(run).at(0), last);
  }
  // A wrong one does no harm.
  writeScan("easy.pcd", 0);
  expectFound(
      linesOf(localize("map.pcd easy.pcd --guess 1,2,3" + std::string(LEAF))).at(0), 0);
}

TEST_F(CliLocalize, uprightMotionsKeepWhatIsUp)
{
  writeScans(0, 1);
  const ProgramRun run =
      localize("map.pcd scans/scan_0.pcd --upright --max-tilt 5" + std::string(LEAF));
  EXPECT_EQ(run.status, 0) << run.err;
  expectFound(linesOf(run).at(0), 0);
  // A map that lies on its side, by what is said of it.
  EXPECT_EQ(localize("map.pcd scans/scan_0.pcd --upright --gravity-map 1,0,0" +
                     std::string(LEAF))
                .status,
            1);
}

TEST_F(CliLocalize, writesPosesInTheFormatsOfMaps)
{
  writeScans(0, 2);
  const std::string run = "map.pcd scans --quiet --poses ";
  ASSERT_EQ(localize(run + "p.tum" + LEAF).status, 0);
  EXPECT_EQ(read("p.tum").find("# number tx ty tz qx qy qz qw\n# 0: scan_0.pcd\n"), 0u)
      << read("p.tum");
  ASSERT_EQ(localize(run + "p.kitti" + LEAF).status, 0);
  const std::string kitti = read("p.kitti");
  EXPECT_EQ(std::count(kitti.begin(), kitti.end(), '\n'), 2);
  const ProgramRun json = localize(run + "p.txt --format json" + LEAF);
  const nlohmann::json all = nlohmann::json::parse(read("p.txt"));
  ASSERT_EQ(all.size(), 2u);
  nlohmann::json line = linesOf(json).at(1);
  line.erase("timings_ms");
  EXPECT_EQ(all.at(1), line);
}

TEST_F(CliLocalize, drawsTheMapWithItsScans)
{
  writeScans(0, 2);
  io::writeCloud(path("blob.pcd"), cloudOf(blobPoints()));
  const ProgramRun run =
      localize("map.pcd scans blob.pcd --picture places.png" + std::string(LEAF));
  if (contains(run.err, "--picture is not built into this program"))
    GTEST_SKIP() << "built without Cairo";
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(read("places.png").substr(1, 3), "PNG");
}

TEST_F(CliLocalize, quietLeavesErrorsAndJson)
{
  writeScans(0, 1);
  write("broken.pcd", "no cloud");
  const ProgramRun run =
      localize("map.pcd scans broken.pcd --quiet" + std::string(LEAF));
  EXPECT_EQ(linesOf(run).size(), 2u);
  EXPECT_EQ(run.err.find("pcl_flashreg_localize: error: broken.pcd: "), 0u);
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
}

TEST_F(CliLocalize, findsTheSameOnAnyNumberOfThreads)
{
  writeScans(0, 2);
  const std::string one = untimed(localize("map.pcd scans --threads 1"));
  EXPECT_EQ(untimed(localize("map.pcd scans --threads 3")), one);
}

} // namespace
} // namespace pcl_flashreg::localize
