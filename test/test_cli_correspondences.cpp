// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cli_support.h"

#include <cmath>
#include <iomanip>

namespace pcl_flashreg::cli {
namespace {

/** \brief Keypoints of a made room, and which belong together: every fourth pair is
 * right. */
class CliCorrespondences : public CliTest {
protected:
  void
  SetUp() override
  {
    CliTest::SetUp();
    target_ = roomPoints(kPairs, 4);
    source_ = truth_.rotation.transpose() * (target_.colwise() - truth_.translation);
    io::writeCloud(path("source.ply"), cloudOf(source_, io::ScalarType::Float64));
    io::writeCloud(path("target.ply"), cloudOf(target_, io::ScalarType::Float64));
    made::Random random(6);
    for (Eigen::Index i = 0; i < kPairs; ++i)
      partner_.push_back(
          i % 4 == 0 ? i : static_cast<Eigen::Index>(random.next() % kPairs));
  }

  static std::ostringstream
  text()
  {
    std::ostringstream stream;
    stream << std::setprecision(17);
    return stream;
  }

  static void
  put(std::ostream& stream, const Eigen::Vector3d& p, const char* end)
  {
    stream << p.x() << ' ' << p.y() << ' ' << p.z() << end;
  }

  void
  expectFound(const ProgramRun& run) const
  {
    ASSERT_EQ(run.status, 0) << run.err;
    const auto json = run.json();
    expectTruth(poseOf(json));
    EXPECT_EQ(json.at("correspondences"), kPairs);
    EXPECT_GE(json.at("inliers").get<int>(), kPairs / 4);
    EXPECT_EQ(json.at("timings_ms").at("matching"), 0.0);
  }

  static constexpr Eigen::Index kPairs = 800;
  Eigen::Matrix3Xd source_, target_;
  std::vector<Eigen::Index> partner_;
};

TEST_F(CliCorrespondences, sixColumnsNeedNoClouds)
{
  auto rows = text();
  rows << "# sx sy sz tx ty tz\n\n";
  for (Eigen::Index i = 0; i < kPairs; ++i) {
    put(rows, source_.col(i), " ");
    put(rows, target_.col(partner_[static_cast<std::size_t>(i)]), "  # pair\n");
  }
  write("pairs.txt", rows.str());
  expectFound(align("--correspondences pairs.txt --leaf 0.05 --json -"));
  expectFound(align("--correspondences pairs.txt --json -"));
  const ProgramRun run =
      align("source.ply target.ply out.ply --correspondences pairs.txt --quiet");
  EXPECT_EQ(run.status, 0) << run.err;
  const Eigen::Matrix3Xd aligned = io::coordinates(io::readCloud(path("out.ply")));
  EXPECT_LT((aligned - target_).cwiseAbs().maxCoeff(), 0.01);
}

TEST_F(CliCorrespondences, twoFilesOfThreeColumns)
{
  auto sources = text(), targets = text();
  for (Eigen::Index i = 0; i < kPairs; ++i) {
    put(sources, source_.col(i), "\n");
    put(targets, target_.col(partner_[static_cast<std::size_t>(i)]), "\n");
  }
  write("src.txt", sources.str());
  write("dst.txt", targets.str());
  expectFound(align("--correspondences src.txt,dst.txt --leaf 0.05 --json -"));
}

TEST_F(CliCorrespondences, indexPairsNeedTheClouds)
{
  auto rows = text();
  for (std::size_t i = 0; i < kPairs; ++i)
    rows << i << ' ' << partner_[i] << '\n';
  write("pairs.txt", rows.str());
  expectFound(align("source.ply target.ply --correspondences pairs.txt --json -"));
  const ProgramRun run = align("--correspondences pairs.txt");
  EXPECT_EQ(run.status, 2);
  EXPECT_NE(run.err.find("need the source and the target cloud"), std::string::npos);
}

TEST_F(CliCorrespondences, rowsThatAreNotFiniteAreCounted)
{
  auto rows = text();
  for (Eigen::Index i = 0; i < kPairs; ++i) {
    if (i % 8 == 1)
      rows << "nan ";
    else
      rows << source_(0, i) << ' ';
    rows << source_(1, i) << ' ' << source_(2, i) << ' ';
    put(rows, target_.col(partner_[static_cast<std::size_t>(i)]), "\n");
  }
  write("pairs.txt", rows.str());
  const ProgramRun run = align("--correspondences pairs.txt --leaf 0.05 --json -");
  expectFound(run);
  EXPECT_EQ(run.json().at("correspondences_invalid"), kPairs / 8);
}

TEST_F(CliCorrespondences, aGuessIsOneMoreHypothesis)
{
  auto rows = text();
  for (Eigen::Index i = 0; i < kPairs; ++i) {
    put(rows, source_.col(i), " ");
    put(rows, target_.col(partner_[static_cast<std::size_t>(i)]), "\n");
  }
  write("pairs.txt", rows.str());
  write("right.txt", io::formatTransform(truth_));
  write("wrong.txt", "1 0 0 9\n0 1 0 9\n0 0 1 9\n0 0 0 1\n");
  const std::string common =
      "--correspondences pairs.txt --leaf 0.05 --json - --guess ";
  expectFound(align(common + "right.txt"));
  expectFound(align(common + "wrong.txt"));
}

TEST_F(CliCorrespondences, whatAPoseLacksIsSaid)
{
  const auto said =
      [&](const auto& source_of, const auto& target_of, const char* leaf) {
        auto rows = text();
        for (Eigen::Index i = 0; i < kPairs; ++i) {
          put(rows, source_of(i), " ");
          put(rows, target_of(i), "\n");
        }
        write("pairs.txt", rows.str());
        const ProgramRun run =
            align(std::string("--correspondences pairs.txt --leaf ") + leaf);
        EXPECT_EQ(run.status, 1) << run.err;
        return run.out;
      };
  const auto target = [&](Eigen::Index i) { return Eigen::Vector3d(target_.col(i)); };
  const auto mirrored = [&](Eigen::Index i) {
    return Eigen::Vector3d(-source_(0, i), source_(1, i), source_(2, i));
  };
  EXPECT_NE(said(mirrored, target, "0.05").find("mirror image"), std::string::npos);

  made::Random random(2);
  const auto on_a_line = [&](Eigen::Index i) {
    const double x = random.normal(), y = random.normal();
    return Eigen::Vector3d(0.003 * x, 0.003 * y, 0.01 * static_cast<double>(i));
  };
  EXPECT_NE(said(on_a_line, on_a_line, "0.05").find("on a line"), std::string::npos);

  const auto anywhere = [&](Eigen::Index) { return random.inCube(1); };
  EXPECT_NE(said(anywhere, anywhere, "0.1").find("by chance"), std::string::npos);
}

TEST_F(CliCorrespondences, descriptorsFromFiles)
{
  // A descriptor that is different for every point, the same on both sides.
  const auto describe = [](std::size_t size) {
    io::Cloud cloud;
    cloud.addField("fpfh", io::ScalarType::Float32, 33);
    cloud.width = size;
    cloud.data.resize(size * cloud.point_size);
    made::Random random(9);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t k = 0; k < 33; ++k)
        io::storeValue(cloud.point(i), cloud.fields[0], random.uniform(0, 100), k);
    return cloud;
  };
  io::writeCloud(path("f.pcd"), describe(kPairs));
  io::writeCloud(path("short.pcd"), describe(kPairs - 1));
  const ProgramRun run = align("source.ply target.ply --features f.pcd,f.pcd --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  expectTruth(poseOf(run.json()));
  EXPECT_EQ(run.json().at("correspondences"), kPairs);
  EXPECT_EQ(run.json().at("timings_ms").at("features"), 0.0);
  const ProgramRun mismatch = align("source.ply target.ply --features f.pcd,short.pcd");
  EXPECT_EQ(mismatch.status, 3);
  EXPECT_NE(mismatch.err.find("799 descriptors"), std::string::npos) << mismatch.err;
  EXPECT_EQ(align("source.ply target.ply --features f.pcd,target.ply").status, 3);
}

} // namespace
} // namespace pcl_flashreg::cli
