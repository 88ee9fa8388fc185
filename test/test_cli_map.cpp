// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_map as a user runs it: what it finds, says and writes.

#include "cli_map_support.h"
#include "io/text.h"

#include <pcl_flashreg/estimator.h>
#include <pcl_flashreg/multiview_registration.h>

#include <map>
#include <sstream>

namespace pcl_flashreg::map {
namespace {

/** \brief The numbers of each line that does not begin as a comment. */
std::vector<std::vector<double>>
rowsOf(const std::string& text)
{
  std::vector<std::vector<double>> rows;
  io::LineReader lines(text);
  for (std::string_view line; lines.next(line);) {
    if (line.front() == '#')
      continue;
    rows.emplace_back();
    for (const std::string_view word : io::splitWords(line)) {
      rows.back().push_back(0);
      EXPECT_TRUE(io::parseDouble(word, rows.back().back())) << word;
    }
  }
  return rows;
}

Eigen::Isometry3d
poseFrom(const double* t_and_q)
{
  const double* q = t_and_q + 3;
  Eigen::Isometry3d pose(Eigen::Quaterniond(q[3], q[0], q[1], q[2]));
  pose.pretranslate(Eigen::Vector3d(t_and_q[0], t_and_q[1], t_and_q[2]));
  return pose;
}

class CliMap : public MapTest {};

TEST_F(CliMap, placesAllScansAndSaysSo)
{
  writeScans(0, 8);
  const ProgramRun run = makeMap("scans map.pcd");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out.find("all 8 scans are placed, in one map\n"), 0u) << run.out;
  EXPECT_NE(run.out.find("\npairs       28 registered\nedges       "),
            std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("estimated"), std::string::npos) << run.out;
  EXPECT_EQ(run.out.find("not placed"), std::string::npos) << run.out;
  const io::Cloud cloud = io::readCloud(path("map.pcd"));
  EXPECT_NE(cloud.find("intensity"), nullptr);
  EXPECT_NE(run.out.find("\nwritten     map.pcd (" + std::to_string(cloud.size()) +
                         " points)\n"),
            std::string::npos)
      << run.out;
  // All that one scan lacks, others have; in its frame, which is that of the room.
  const Eigen::Matrix3Xd xyz = io::coordinates(cloud);
  EXPECT_LT(xyz.rowwise().minCoeff().norm(), 0.1);
  EXPECT_LT((xyz.rowwise().maxCoeff() - Eigen::Vector3d(3, 2.4, 2)).norm(), 0.1);
}

TEST_F(CliMap, jsonHasItsKeys)
{
  writeScans(0, 4);
  const ProgramRun run = makeMap("scans --json - --quiet" + std::string(LEAF));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const auto json = run.json();
  EXPECT_EQ(json.at("version"), version());
  EXPECT_EQ(json.at("complete"), true);
  EXPECT_EQ(json.at("placed"), 4);
  EXPECT_EQ(json.at("resolution"), 0.1);
  EXPECT_EQ(json.at("min_confidence"), MultiviewOptions().min_confidence);
  EXPECT_EQ(json.at("motion"), "rigid");
  EXPECT_EQ(json.at("pairs"), 6);
  EXPECT_EQ(json.at("left_out").size(), 0u);
  EXPECT_EQ(json.at("groups"), nlohmann::json({{0, 1, 2, 3}}));
  for (std::size_t i = 0; i < 4; ++i) {
    const auto& scan = json.at("scans").at(i);
    EXPECT_EQ(scan.at("name"), "scan_" + std::to_string(i) + ".pcd");
    EXPECT_EQ(scan.at("path"), "scans/scan_" + std::to_string(i) + ".pcd");
    EXPECT_EQ(scan.at("group"), 1);
    EXPECT_GE(scan.at("confidence"), MultiviewOptions().min_confidence);
    EXPECT_GT(scan.at("edges").get<int>(), 0);
    EXPECT_LT(errorOf(poseOf(scan.at("transformation")), i), 0.03);
  }
  int used = 0;
  for (const auto& edge : json.at("edges")) {
    EXPECT_LT(edge.at("target"), edge.at("source"));
    EXPECT_GE(edge.at("translation_residual"), 0);
    EXPECT_GE(edge.at("rotation_residual"), 0);
    EXPECT_GT(edge.at("pair_confidence"), 0);
    if (edge.at("fate") != "used")
      continue;
    ++used;
    EXPECT_GT(edge.at("matched"), 0);
    EXPECT_EQ(edge.at("information").size(), 6u);
    EXPECT_EQ(edge.at("transformation").size(), 4u);
  }
  EXPECT_GE(used, 3);
  for (const char* step : {"reading", "relations", "placing", "total"})
    EXPECT_GT(json.at("timings_ms").at(step).get<double>(), 0) << step;
}

TEST_F(CliMap, writesPosesInAllFormats)
{
  writeScans(0, 4);
  ASSERT_EQ(
      makeMap("scans --poses p.json --pairs pairs.csv" + std::string(LEAF)).status, 0);
  for (const char* poses : {"p.tum", "p.txt", "p.kitti", "p.csv"})
    ASSERT_EQ(makeMap("scans --pairs pairs.csv --resume --poses " + std::string(poses))
                  .status,
              0);
  const auto json = nlohmann::json::parse(read("p.json"));
  EXPECT_FALSE(json.contains("timings_ms"));
  EXPECT_EQ(read("p.tum"), read("p.txt"));
  EXPECT_NE(read("p.tum").find("# 2: scan_2.pcd\n"), std::string::npos);
  const auto tum = rowsOf(read("p.tum")), kitti = rowsOf(read("p.kitti"));
  ASSERT_EQ(tum.size(), 4u);
  ASSERT_EQ(kitti.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Isometry3d pose = poseOf(json["scans"][i]["transformation"]);
    ASSERT_EQ(tum[i].size(), 8u);
    EXPECT_EQ(tum[i][0], static_cast<double>(i));
    EXPECT_TRUE(poseFrom(&tum[i][1]).isApprox(pose, 1e-12));
    ASSERT_EQ(kitti[i].size(), 12u);
    for (std::size_t k = 0; k < 12; ++k)
      EXPECT_EQ(kitti[i][k],
                pose.matrix()(static_cast<int>(k / 4), static_cast<int>(k % 4)));
  }
  const std::string csv = read("p.csv");
  EXPECT_EQ(csv.find("name,group,confidence,edges,tx,ty,tz,qx,qy,qz,qw\n"), 0u) << csv;
  EXPECT_NE(csv.find("\nscan_3.pcd,1,"), std::string::npos) << csv;
  // A format beats the name.
  ASSERT_EQ(
      makeMap("scans --pairs pairs.csv --resume --poses poses --format csv").status, 0);
  EXPECT_EQ(read("poses"), csv);
}

TEST_F(CliMap, timesInNamesAreTimesInTum)
{
  writeScans(0, 2);
  fs::rename(path("scans/scan_0.pcd"), path("scans/1311868164.363181.pcd"));
  fs::rename(path("scans/scan_1.pcd"), path("scans/1311868164.399026.pcd"));
  ASSERT_EQ(makeMap("scans --poses p.tum" + std::string(LEAF)).status, 0);
  EXPECT_NE(read("p.tum").find("\n1311868164.399026 "), std::string::npos)
      << read("p.tum");
}

TEST_F(CliMap, theGraphIsG2os)
{
  writeScans(0, 4);
  const ProgramRun run =
      makeMap("scans --graph g.g2o --json - --quiet" + std::string(LEAF));
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  std::map<std::string, int> lines;
  std::istringstream text(read("g.g2o"));
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string tag;
    words >> tag;
    ++lines[tag];
    std::vector<double> numbers;
    for (double number = 0; words >> number;)
      numbers.push_back(number);
    if (tag == "FIX") {
      EXPECT_EQ(numbers, std::vector<double>{0});
    }
    else if (tag == "VERTEX_SE3:QUAT") {
      ASSERT_EQ(numbers.size(), 8u);
      const auto scan = static_cast<std::size_t>(numbers[0]);
      EXPECT_TRUE(poseFrom(&numbers[1])
                      .isApprox(poseOf(json["scans"][scan]["transformation"]), 1e-12));
    }
    else {
      ASSERT_EQ(tag, "EDGE_SE3:QUAT");
      ASSERT_EQ(numbers.size(), 2u + 7u + 21u);
      const auto target = static_cast<std::size_t>(numbers[0]),
                 source = static_cast<std::size_t>(numbers[1]);
      // The second vertex in the frame of the first.
      const Eigen::Isometry3d expected =
          poseOf(json["scans"][target]["transformation"]).inverse() *
          poseOf(json["scans"][source]["transformation"]);
      EXPECT_LT((poseFrom(&numbers[2]).matrix() - expected.matrix()).norm(), 0.1);
    }
  }
  EXPECT_EQ(lines["VERTEX_SE3:QUAT"], 4);
  EXPECT_EQ(lines["FIX"], 1);
  EXPECT_GE(lines["EDGE_SE3:QUAT"], 3);
}

TEST_F(CliMap, drawsAndWritesAPage)
{
  writeScans(0, 3);
  const ProgramRun run =
      makeMap("scans --page page.md --picture map.png --threads 2" + std::string(LEAF));
  if (run.err.find("--picture is not built into this program") != std::string::npos)
    GTEST_SKIP() << "built without Cairo";
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(read("map.png").substr(1, 3), "PNG");
  const std::string page = read("page.md");
  for (const char* text : {"--leaf 0.1", "--threads 2", "placing"})
    EXPECT_NE(page.find(text), std::string::npos) << page;
}

TEST_F(CliMap, namesScansThatItCannotPlace)
{
  writeScans(0, 3);
  writeBlob("scans/blob.pcd");
  const ProgramRun run =
      makeMap("scans map.pcd --poses p.csv --json r.json" + std::string(LEAF));
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(run.out.find("3 of 4 scans are placed, in one map\n"), 0u) << run.out;
  EXPECT_NE(run.out.find("\nnot placed  blob.pcd\n"), std::string::npos) << run.out;
  EXPECT_NE(read("p.csv").find("\nblob.pcd,,0,0,,,,,,,\n"), std::string::npos)
      << read("p.csv");
  const auto json = nlohmann::json::parse(read("r.json"));
  EXPECT_EQ(json["complete"], false);
  EXPECT_TRUE(json["scans"][0]["group"].is_null());
  EXPECT_TRUE(json["scans"][0]["transformation"].is_null());
}

/** \brief Two rooms of two scans; the second, which is twice as large, has three. */
class CliMaps : public MapTest {
protected:
  void
  SetUp() override
  {
    MapTest::SetUp();
    writeScans(0, 2);
    for (std::size_t i = 0; i < 3; ++i) {
      io::Cloud cloud = madeScan(i, 1000).cloud;
      RigidTransform larger;
      larger.rotation *= 2;
      io::transformCloud(cloud, larger);
      io::writeCloud(path("scans/x_" + std::to_string(i) + ".pcd"), cloud);
    }
  }
};

TEST_F(CliMaps, goToFilesOfTheirOwn)
{
  const ProgramRun run =
      makeMap("scans map.pcd --poses p.kitti --graph g.g2o" + std::string(LEAF));
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(
      run.out.find("all 5 scans are placed, in 2 maps that nothing ties together\n"
                   "map 1       x_0.pcd, x_1.pcd, x_2.pcd\n"
                   "map 2       scan_0.pcd, scan_1.pcd\n"),
      0u)
      << run.out;
  const Eigen::Matrix3Xd large = io::coordinates(io::readCloud(path("map.pcd"))),
                         small = io::coordinates(io::readCloud(path("map_2.pcd")));
  EXPECT_GT(large.row(0).maxCoeff(), 5);
  EXPECT_LT(small.row(0).maxCoeff(), 4);
  EXPECT_EQ(rowsOf(read("p.kitti")).size(), 3u);
  EXPECT_EQ(rowsOf(read("p_2.kitti")).size(), 2u);
  EXPECT_NE(read("g.g2o").find("FIX 2\nFIX 0\n"), std::string::npos);
}

TEST_F(CliMaps, largestOnly)
{
  const ProgramRun run =
      makeMap("scans map.pcd --poses p.kitti --largest-only" + std::string(LEAF));
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_TRUE(fs::exists(path("map.pcd")));
  EXPECT_FALSE(fs::exists(path("map_2.pcd")));
  EXPECT_FALSE(fs::exists(path("p_2.kitti")));
}

TEST_F(CliMap, saysWhatIsNotOfThisRun)
{
  writeScans(0, 2);
  write("map_2.pcd", "old");
  const ProgramRun run = makeMap("scans map.pcd" + std::string(LEAF));
  EXPECT_EQ(run.status, 0);
  EXPECT_NE(run.err.find("note: map_2.pcd was there before, and is not of this run"),
            std::string::npos)
      << run.err;
}

TEST_F(CliMap, withoutAMapWritesNoCloud)
{
  writeScans(0, 1);
  writeBlob("scans/blob.pcd");
  const ProgramRun run = makeMap("scans map.pcd" + std::string(LEAF));
  EXPECT_EQ(run.status, 1) << run.err;
  EXPECT_EQ(run.out.find("no map: nothing ties any two of 2 scans together"), 0u)
      << run.out;
  EXPECT_NE(run.err.find("map.pcd is not written"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(path("map.pcd")));
}

TEST_F(CliMap, theMapHasVoxelsOfItsOwn)
{
  writeScans(0, 2);
  ASSERT_EQ(makeMap("scans map.pcd" + std::string(LEAF)).status, 0);
  ASSERT_EQ(makeMap("scans fine.ply --map-leaf 0.02" + std::string(LEAF)).status, 0);
  EXPECT_GT(io::readCloud(path("fine.ply")).size(),
            2 * io::readCloud(path("map.pcd")).size());
}

} // namespace
} // namespace pcl_flashreg::map
