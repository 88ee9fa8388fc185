// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cli_support.h"
#include "support/made_places.h"

#include <pcl_flashreg/estimator.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace pcl_flashreg::cli {
namespace {

using io::ScalarType;

TEST_F(CliTest, findsThePoseAndSaysSo)
{
  writeRoom("source.pcd", "target.pcd");
  const ProgramRun run = align("source.pcd target.pcd");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  EXPECT_NE(run.out.find("pose found and trusted"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find(" correspondences"), std::string::npos);
  EXPECT_NE(run.out.find(" ms"), std::string::npos);
}

TEST_F(CliTest, jsonHasItsKeys)
{
  writeRoom("source.pcd", "target.pcd");
  const ProgramRun run = align("source.pcd target.pcd --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  const auto json = run.json();
  expectTruth(poseOf(json));
  EXPECT_EQ(json.at("converged"), true);
  EXPECT_EQ(json.at("status"), "ok");
  EXPECT_GE(json.at("inliers").get<int>(), 12);
  EXPECT_GE(json.at("correspondences"), json.at("inliers"));
  EXPECT_EQ(json.at("correspondences_dropped"), 0);
  EXPECT_EQ(json.at("score"), json.at("inliers").get<double>());
  EXPECT_EQ(json.at("backend").get<std::string>().substr(0, 4), "cpu-");
  EXPECT_EQ(json.at("source"), "source.pcd");
  EXPECT_EQ(json.at("target"), "target.pcd");
  EXPECT_EQ(json.at("version"), version());
  EXPECT_EQ(json.at("resolution"), 0.1);
  EXPECT_FALSE(json.at("hypotheses").empty());
  EXPECT_EQ(json.at("information").size(), 6u);
  const auto& timings = json.at("timings_ms");
  double sum = 0;
  for (const char* step : {"reading",
                           "setup",
                           "resolution",
                           "voxel_grid",
                           "normals",
                           "features",
                           "matching",
                           "estimation",
                           "copying"}) {
    EXPECT_GT(timings.at(step).get<double>(), 0) << step;
    sum += timings.at(step).get<double>();
  }
  EXPECT_NEAR(timings.at("total").get<double>(), sum, 1e-6 * sum);
  double estimation = 0;
  for (const Stage& stage : STAGES) {
    EXPECT_GE(timings.at(stage.name).get<double>(), 0) << stage.name;
    estimation += timings.at(stage.name).get<double>();
  }
  EXPECT_LE(estimation, timings.at("estimation").get<double>() * (1 + 1e-9));
}

/** \brief Numbers in a text, in their order. */
std::vector<double>
numbersIn(const std::string& text)
{
  std::vector<double> numbers;
  for (const char* at = text.c_str(); *at != 0;) {
    char* end = nullptr;
    const double number = std::strtod(at, &end);
    if (end == at) {
      ++at;
      continue;
    }
    numbers.push_back(number);
    at = end;
  }
  return numbers;
}

TEST_F(CliTest, stepsAddUpToTheTotal)
{
  writeRoom("source.pcd", "target.pcd");
  for (const std::string options : {"", " --leaf 0.1 --fast"}) {
    const ProgramRun run = align("source.pcd target.pcd" + options);
    const std::size_t time = run.out.find("time  "), end = run.out.find('\n', time);
    ASSERT_NE(end, std::string::npos) << run.out;
    const double total = numbersIn(run.out.substr(time, end - time)).at(0);
    const std::string listing = run.out.substr(end);
    const std::vector<double> steps = numbersIn(listing);
    EXPECT_GE(steps.size(), 5u);
    // Steps of less than 0.05 ms are left out, the others are rounded.
    constexpr double STEP_COUNT = 10;
    EXPECT_NEAR(std::accumulate(steps.begin(), steps.end(), 0.0),
                total,
                (STEP_COUNT + 1) * 0.05 + 1e-9)
        << run.out;
    EXPECT_NE(listing.find("matching"), std::string::npos) << run.out;
    EXPECT_EQ(listing.find("cloud check") == std::string::npos, !options.empty())
        << run.out;
  }
}

TEST_F(CliTest, asksForTheUnitWhereTheCloudsDifferALot)
{
  writeRoom("source.pcd", "target.pcd");
  const auto run = [&](double scale) {
    io::Cloud scaled = io::readCloud(path("target.pcd"));
    RigidTransform scaling;
    scaling.rotation *= scale;
    io::transformCloud(scaled, scaling);
    io::writeCloud(path("scaled.pcd"), scaled);
    return align("source.pcd scaled.pcd");
  };
  for (const double scale : {0.001, 10.0}) {
    const ProgramRun result = run(scale);
    EXPECT_NE(result.status, 0);
    EXPECT_NE(result.err.find("in the same unit?"), std::string::npos) << result.err;
  }
  EXPECT_EQ(run(1).err, "");
}

TEST_F(CliTest, describesWithPclToo)
{
  writeRoom("source.pcd", "target.pcd");
  const ProgramRun run =
      align("source.pcd target.pcd --leaf 0.1 --features pcl --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  expectTruth(poseOf(run.json()));
  EXPECT_EQ(align("source.pcd target.pcd --leaf 0.1 --features native").status, 0);
}

TEST_F(CliTest, writesEverythingItIsAskedFor)
{
  writeRoom("source.pcd", "target.pcd");
  const ProgramRun run = align("source.pcd target.pcd aligned.ply --json out.json "
                               "--transform pose.txt --quiet");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
  const RigidTransform pose = io::parseFile(path("pose.txt"), io::parseTransform);
  expectTruth(pose);
  const auto json = nlohmann::json::parse(read("out.json"));
  EXPECT_EQ(poseOf(json).translation, pose.translation);
  const Eigen::Matrix3Xd aligned = io::coordinates(io::readCloud(path("aligned.ply")));
  const Eigen::Matrix3Xd expected =
      (pose.rotation * sourcePoints()).colwise() + pose.translation;
  EXPECT_LT((aligned - expected).cwiseAbs().maxCoeff(), 1e-5);
}

TEST_F(CliTest, keepsAllFields)
{
  const std::vector<io::Field> more = {{"normal_x", ScalarType::Float32, 1, 0},
                                       {"normal_y", ScalarType::Float32, 1, 0},
                                       {"normal_z", ScalarType::Float32, 1, 0},
                                       {"intensity", ScalarType::Float32, 1, 0},
                                       {"rgb", ScalarType::Float32, 1, 0},
                                       {"ring", ScalarType::Uint16, 1, 0},
                                       {"stamp", ScalarType::Uint64, 1, 0},
                                       {"histogram", ScalarType::Float32, 4, 0}};
  io::Cloud source = cloudOf(sourcePoints(), ScalarType::Float64, more);
  source.viewpoint = {-1, 2, 0.5, 0.5, 0.5, -0.5, 0.5};
  io::Cloud target = cloudOf(roomPoints(kPoints, 2));
  target.viewpoint = {1, 2, 3, 1, 0, 0, 0};
  io::writeCloud(path("source.pcd"), source);
  io::writeCloud(path("target.pcd"), target);
  const ProgramRun run =
      align("source.pcd target.pcd aligned.pcd --transform pose.txt");
  ASSERT_EQ(run.status, 0) << run.err;
  const io::Cloud aligned = io::readCloud(path("aligned.pcd"));
  ASSERT_EQ(aligned.fields.size(), source.fields.size());
  const RigidTransform pose = io::parseFile(path("pose.txt"), io::parseTransform);
  io::Cloud moved = source;
  io::transformCloud(moved, pose);
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_NEAR(aligned.viewpoint[i], moved.viewpoint[i], 1e-9);
  for (std::size_t f = 0; f < source.fields.size(); ++f) {
    const io::Field& field = aligned.fields[f];
    EXPECT_EQ(field.name, source.fields[f].name);
    EXPECT_EQ(field.type, source.fields[f].type);
    EXPECT_EQ(field.count, source.fields[f].count);
    if (f < 6)
      continue;
    for (std::size_t i = 0; i < source.size(); ++i)
      ASSERT_EQ(std::memcmp(aligned.point(i) + field.offset,
                            source.point(i) + field.offset,
                            field.byteSize()),
                0)
          << field.name << " of point " << i;
  }
  const auto normalOf = [](const io::Cloud& cloud) {
    Eigen::Vector3d normal;
    for (std::size_t k = 0; k < 3; ++k)
      normal[static_cast<Eigen::Index>(k)] =
          io::loadValue(cloud.point(5), cloud.fields[3 + k]);
    return normal;
  };
  EXPECT_LT((normalOf(aligned) - pose.rotation * normalOf(source)).norm(), 1e-4);
}

TEST_F(CliTest, saysWhatItHadToGuess)
{
  writeRoom("source.pcd", "target.pcd");
  std::string bytes = io::readFile(path("source.pcd"));
  bytes.replace(bytes.find("x y z"), 5, "X Y Z");
  io::writeFile(path("source.pcd"), bytes);
  const ProgramRun run = align("source.pcd target.pcd");
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err,
            "pcl_flashreg_align: note: source.pcd: fields are taken for coordinates: "
            "'X' 'Y' 'Z'\n");
  EXPECT_EQ(align("source.pcd target.pcd --quiet").err, "");
}

TEST_F(CliTest, geoReferencedDoublesKeepTheirPrecision)
{
  const Eigen::Vector3d utm(500000, 4000000, 300);
  const Eigen::Matrix3Xd room = roomPoints(kPoints, 2);
  io::writeCloud(path("source.ply"), cloudOf(sourcePoints(), ScalarType::Float64));
  io::writeCloud(path("target.ply"), cloudOf(room, ScalarType::Float64));
  io::writeCloud(path("source_utm.ply"),
                 cloudOf(sourcePoints().colwise() + utm, ScalarType::Float64));
  io::writeCloud(path("target_utm.ply"),
                 cloudOf(room.colwise() + utm, ScalarType::Float64));
  const ProgramRun near = align("source.ply target.ply --leaf 0.1 --json -");
  const ProgramRun far =
      align("source_utm.ply target_utm.ply far.ply --leaf 0.1 --json -");
  ASSERT_EQ(near.status, 0) << near.err;
  ASSERT_EQ(far.status, 0) << far.err;
  expectTruth(poseOf(near.json()));
  RigidTransform pose = poseOf(far.json());
  pose.translation += pose.rotation * utm - utm;
  expectTruth(pose);
  const io::Cloud aligned = io::readCloud(path("far.ply"));
  EXPECT_EQ(aligned.find("x")->type, ScalarType::Float64);
  const Eigen::Matrix3Xd back = io::coordinates(aligned).colwise() - utm;
  const Eigen::Matrix3Xd expected =
      (pose.rotation * sourcePoints()).colwise() + pose.translation;
  EXPECT_LT((back - expected).cwiseAbs().maxCoeff(), 1e-6);
}

TEST_F(CliTest, floatsThatMoveFarAwayBecomeDoubles)
{
  const Eigen::Vector3d utm(500000, 4000000, 300);
  io::writeCloud(path("source.pcd"), cloudOf(sourcePoints()));
  io::writeCloud(path("target.ply"),
                 cloudOf(roomPoints(kPoints, 2).colwise() + utm, ScalarType::Float64));
  const ProgramRun run = align("source.pcd target.ply far.pcd --leaf 0.1");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("written as doubles"), std::string::npos);
  EXPECT_EQ(io::readCloud(path("far.pcd")).find("x")->type, ScalarType::Float64);
}

TEST_F(CliTest, readsKittiScans)
{
  for (const bool is_source : {true, false}) {
    const Eigen::Matrix3Xd xyz = is_source ? sourcePoints() : roomPoints(kPoints, 2);
    const io::Cloud cloud =
        cloudOf(xyz, ScalarType::Float32, {{"intensity", ScalarType::Float32, 1, 0}});
    write(is_source ? "s.bin" : "t.bin", {cloud.data.begin(), cloud.data.end()});
  }
  const ProgramRun run = align("s.bin t.bin aligned.pcd --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  expectTruth(poseOf(run.json()));
  const io::Cloud aligned = io::readCloud(path("aligned.pcd"));
  ASSERT_NE(aligned.find("intensity"), nullptr);
  EXPECT_EQ(io::loadValue(aligned.point(100), *aligned.find("intensity")),
            (100 * 7 + 3) % 251);
}

TEST_F(CliTest, readsRawScansOfOtherLayouts)
{
  for (const bool is_source : {true, false}) {
    const Eigen::Matrix3Xd xyz = is_source ? sourcePoints() : roomPoints(kPoints, 2);
    io::Cloud cloud = cloudOf(xyz,
                              ScalarType::Float32,
                              {{"intensity", ScalarType::Float32, 1, 0},
                               {"ring", ScalarType::Float32, 1, 0}});
    for (std::size_t i = 0; i < cloud.size(); ++i)
      io::storeValue(cloud.point(i), cloud.fields[4], static_cast<double>(i % 32));
    write(is_source ? "s.pcd.bin" : "t.bin", {cloud.data.begin(), cloud.data.end()});
  }
  for (const char* option : {"", " --bin-fields 5"}) {
    const ProgramRun run =
        align(std::string("s.pcd.bin t.bin aligned.pcd --json -") + option);
    ASSERT_EQ(run.status, 0) << run.err;
    expectTruth(poseOf(run.json()));
    EXPECT_NE(io::readCloud(path("aligned.pcd")).find("ring"), nullptr);
  }
}

TEST_F(CliTest, pointsThatAreNotFiniteAreSkippedAndKept)
{
  Eigen::Matrix3Xd xyz = sourcePoints();
  for (Eigen::Index i = 0; i < xyz.cols(); i += 10)
    xyz(i % 3, i) = std::nan("");
  io::writeCloud(path("source.pcd"), cloudOf(xyz));
  io::writeCloud(path("target.pcd"), cloudOf(roomPoints(kPoints, 2)));
  const ProgramRun run = align("source.pcd target.pcd aligned.pcd --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  expectTruth(poseOf(run.json()));
  EXPECT_EQ(io::readCloud(path("aligned.pcd")).size(), kPoints);
}

TEST_F(CliTest, sameResultWithEveryNumberOfThreads)
{
  writeRoom("source.pcd", "target.pcd");
  const auto resultOf = [&](const std::string& threads) {
    auto json = align("source.pcd target.pcd --json - --threads " + threads).json();
    json.erase("timings_ms");
    return json.dump();
  };
  const std::string one = resultOf("1");
  EXPECT_EQ(resultOf("2"), one);
  EXPECT_EQ(resultOf("0"), one);
}

TEST_F(CliTest, mutualMatchesAndSeveralNeighbors)
{
  writeRoom("source.pcd", "target.pcd");
  const auto count = [&](const std::string& options) {
    const ProgramRun run =
        align("source.pcd target.pcd --leaf 0.1 --json - " + options);
    EXPECT_EQ(run.status, 0) << options << run.err;
    expectTruth(poseOf(run.json()));
    return run.json().at("correspondences").get<int>();
  };
  const int one_way = count("");
  EXPECT_EQ(count("--neighbors 2"), 2 * one_way);
  EXPECT_LT(count("--mutual"), one_way);
}

TEST_F(CliTest, optionsReachTheEstimator)
{
  writeRoom("source.pcd", "target.pcd");
  const std::string common = "source.pcd target.pcd --leaf 0.1 --json - ";
  const auto json =
      align(common + "--length-tolerance 0.02 --max-correspondences 100 "
                     "--second-order bounded --score mse --min-confidence 0.3 "
                     "--max-hypotheses 2 --backend cpu")
          .json();
  EXPECT_NEAR(json.at("parameters").at("length_tolerance").get<double>(), 0.02, 1e-8);
  EXPECT_NEAR(json.at("parameters").at("inlier_distance").get<double>(), 0.2, 1e-8);
  EXPECT_EQ(json.at("correspondences_dropped").get<int>(),
            json.at("correspondences").get<int>() - 100);
  EXPECT_EQ(json.at("second_order"), "bounded");
  EXPECT_LT(json.at("score").get<double>(), json.at("inliers").get<double>());
  EXPECT_LE(json.at("hypotheses").size(), 2u);
  EXPECT_NEAR(json.at("parameters").at("min_confidence").get<double>(), 0.3, 1e-6);
  EXPECT_EQ(align(common + "--min-confidence 1").status, 1);
}

TEST_F(CliTest, knowsWhichWayIsUp)
{
  writeRoom("source.pcd", "target.pcd");
  const Eigen::Vector3d down = truth_.rotation.transpose() * -Eigen::Vector3d::UnitZ();
  std::ostringstream options;
  options << "source.pcd target.pcd --leaf 0.1 --upright --max-tilt 2 --gravity 0,0,-1 "
             "--gravity-source "
          << down.x() << ',' << down.y() << ',' << down.z();
  const ProgramRun said = align(options.str());
  EXPECT_EQ(said.status, 0) << said.err;
  EXPECT_NE(said.out.find("motion      upright, up to 2 degrees off"),
            std::string::npos)
      << said.out;
  const auto json = align(options.str() + " --json -").json();
  expectTruth(poseOf(json));
  EXPECT_EQ(json.at("evidence").at("tilted"), 0);
  const auto& parameters = json.at("parameters");
  EXPECT_EQ(parameters.at("motion"), "upright");
  EXPECT_EQ(parameters.at("max_tilt"), 2);
  EXPECT_EQ(parameters.at("target_gravity"), nlohmann::json({0, 0, -1}));
  EXPECT_NEAR(parameters.at("source_gravity").at(1).get<double>(), down.y(), 1e-5);

  const ProgramRun wrong = align(options.str() + " --gravity-target 0.4,0,-1");
  EXPECT_EQ(wrong.status, 1) << "20 degrees off: " << wrong.out;
  EXPECT_EQ(align("source.pcd target.pcd --leaf 0.1 --json -")
                .json()
                .at("parameters")
                .at("motion"),
            "rigid");
}

TEST_F(CliTest, theCloudsHaveASayUnlessToldOtherwise)
{
  writeRoom("source.pcd", "target.pcd");
  const std::string common = "source.pcd target.pcd --leaf 0.1 --json - ";
  const auto full = align(common).json();
  EXPECT_GE(full.at("confidence").get<double>(), 0.6);
  EXPECT_LE(full.at("confidence").get<double>(), 1);
  EXPECT_GT(full.at("evidence").at("matched").get<double>(), 0.3);
  EXPECT_GT(full.at("timings_ms").at("cloud_check").get<double>(), 0);
  expectTruth(poseOf(full));

  const auto unseen = align(common + "--no-viewpoint").json();
  EXPECT_EQ(unseen.at("evidence").at("viewpoints"), false);
  expectTruth(poseOf(unseen));

  for (const char* one :
       {"--no-viewpoint source", "--no-viewpoint=target", "--no-viewpoint target"}) {
    const auto half = align(common + one).json();
    EXPECT_EQ(half.at("evidence").at("viewpoints"), true) << one;
    EXPECT_EQ(half.at("evidence").at("one_viewpoint"), true) << one;
    expectTruth(poseOf(half));
  }
  // A path behind it is a path.
  EXPECT_EQ(align("--no-viewpoint " + common).json().at("evidence"),
            unseen.at("evidence"));
  EXPECT_EQ(align(common + "--no-viewpoint=both").json().at("evidence"),
            unseen.at("evidence"));
  EXPECT_EQ(align(common + "--no-viewpoint=neither").status, 2);

  const auto doubted = align(common + "--min-confidence 1").json();
  EXPECT_GT(doubted.at("timings_ms").at("second_look").get<double>(), 0);
  expectTruth(poseOf(doubted));
  EXPECT_EQ(align(common + "--min-confidence 1 --no-second-look")
                .json()
                .at("timings_ms")
                .at("second_look"),
            0);

  const auto fast = align(common + "--fast").json();
  EXPECT_FALSE(fast.at("evidence").contains("matched"));
  EXPECT_GT(fast.at("evidence").at("inliers").get<double>(), 12);
  expectTruth(poseOf(fast));
}

TEST_F(CliTest, saysWhatIsFree)
{
  const made::Views views = made::corridor(3);
  const auto write = [&](const char* name,
                         const std::vector<double>& xyz,
                         const Eigen::Vector3d& viewpoint) {
    io::Cloud cloud = cloudOf(Eigen::Map<const Eigen::Matrix3Xd>(
        xyz.data(), 3, static_cast<Eigen::Index>(xyz.size() / 3)));
    std::copy_n(viewpoint.data(), 3, cloud.viewpoint.begin());
    io::writeCloud(path(name), cloud);
  };
  write("a.pcd", views.source, views.source_viewpoint);
  write("b.pcd", views.target, views.target_viewpoint);
  const ProgramRun run = align("a.pcd b.pcd --leaf 0.15 --json j");
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_NE(run.out.find("match as well where it is moved off"), std::string::npos)
      << run.out;
  EXPECT_NE(run.out.find("free        may slide along ("), std::string::npos)
      << run.out;
  const auto json = nlohmann::json::parse(read("j"));
  const auto& free = json.at("free_motions").at(0);
  EXPECT_EQ(free.at("kind"), "slide");
  EXPECT_NEAR(std::abs(free.at("direction").at(0).get<double>()), 1, 0.01);
  EXPECT_EQ(free.at("point").size(), 3u);
  EXPECT_GT(free.at("forward").get<double>() + free.at("backward").get<double>(), 2);
  EXPECT_LT(json.at("evidence").at("hold").get<double>(), 0.3);
}

TEST_F(CliTest, anUntrustedPoseIsNotWritten)
{
  made::Random random(5);
  Eigen::Matrix3Xd a(3, 3000), b(3, 3000);
  for (Eigen::Index i = 0; i < a.cols(); ++i) {
    a.col(i) = random.inCube(2);
    b.col(i) = random.inCube(2);
  }
  io::writeCloud(path("a.pcd"), cloudOf(a));
  io::writeCloud(path("b.pcd"), cloudOf(b));
  const std::string command =
      "a.pcd b.pcd c.pcd --leaf 0.1 --transform t.txt --json j ";
  const ProgramRun run = align(command);
  EXPECT_EQ(run.status, 1) << run.out;
  EXPECT_NE(run.out.find("NOT trusted"), std::string::npos) << run.out;
  EXPECT_NE(run.err.find("not written"), std::string::npos) << run.err;
  EXPECT_FALSE(fs::exists(path("c.pcd")));
  EXPECT_FALSE(fs::exists(path("t.txt")));
  EXPECT_EQ(nlohmann::json::parse(read("j")).at("converged"), false);
  EXPECT_EQ(align(command + "--write-untrusted").status, 1);
  EXPECT_TRUE(fs::exists(path("c.pcd")));
  EXPECT_TRUE(fs::exists(path("t.txt")));
}

TEST_F(CliTest, snapshotIsAPng)
{
  writeRoom("source.pcd", "target.pcd");
  const ProgramRun run = align("source.pcd target.pcd --quiet --snapshot pair.png");
  if (run.status == 2 && run.err.find("not built") != std::string::npos)
    GTEST_SKIP() << run.err;
  ASSERT_EQ(run.status, 0) << run.err;
  const std::string bytes = read("pair.png");
  ASSERT_GT(bytes.size(), 10000u);
  EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
  const std::string width_and_height("\0\0\x07\x0c\0\0\x03\x84", 8);
  EXPECT_EQ(bytes.substr(16, 8), width_and_height);
  ASSERT_EQ(align("source.pcd target.pcd --quiet --snapshot again.png").status, 0);
  EXPECT_EQ(read("again.png"), bytes);
}

TEST_F(CliTest, helpAndVersion)
{
  const ProgramRun help = align("--help");
  EXPECT_EQ(help.status, 0);
  for (const char* word :
       {"Examples:", "--correspondences", "--min-confidence", "Exit"})
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  const ProgramRun printed = align("--version");
  EXPECT_EQ(printed.status, 0);
  EXPECT_EQ(printed.out, std::string("pcl_flashreg_align ") + version() + "\n");
}

} // namespace
} // namespace pcl_flashreg::cli
