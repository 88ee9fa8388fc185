// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// pcl_flashreg_align says what it met in its inputs that people should know.

#include "cli_support.h"
#include "support/made_sensor.h"

#include <gtest/gtest.h>

namespace pcl_flashreg::cli {
namespace {

Eigen::Matrix3Xd
columnsOf(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Matrix3Xd xyz(3, static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    xyz.col(static_cast<Eigen::Index>(i)) = points[i];
  return xyz;
}

class Doubts : public CliTest {
protected:
  const Eigen::Vector3d here_{3.0, 2.8, 1.5}, there_{5.2, 3.6, 1.4};

  /** \brief Scans of a hall, each in the frame of its sensor. */
  Eigen::Matrix3Xd
  fromHere() const
  {
    return columnsOf(made::Hall::seenFrom(here_, 30000, 1)).colwise() - here_;
  }

  Eigen::Matrix3Xd
  fromThere() const
  {
    return columnsOf(made::Hall::seenFrom(there_, 30000, 2)).colwise() - there_;
  }

  void
  write(const std::string& name, const Eigen::Matrix3Xd& xyz) const
  {
    io::writeCloud(path(name), cloudOf(xyz));
  }

  void
  expectPose(const nlohmann::json& json, const Eigen::Vector3d& translation) const
  {
    const RigidTransform pose = poseOf(json);
    EXPECT_LT((pose.rotation - Eigen::Matrix3d::Identity()).norm(), 0.02);
    EXPECT_LT((pose.translation - translation).norm(), 0.1) << pose.translation;
  }
};

bool
says(const ProgramRun& run, const std::string& what)
{
  return run.err.find(what) != std::string::npos;
}

TEST_F(Doubts, NothingIsSaidOfGoodScans)
{
  write("source.pcd", fromHere());
  write("target.pcd", fromThere());
  const ProgramRun run = align("source.pcd target.pcd --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.err, "");
  const nlohmann::json json = run.json();
  expectPose(json, here_ - there_);
  EXPECT_EQ(json.at("seen_from").at("source").at("known_by"), "stated");
  EXPECT_EQ(json.at("points_left_out").at("source").at("repeated"), 0);
}

TEST_F(Doubts, BeamsWithoutAReturn)
{
  Eigen::Matrix3Xd zeros(3, 60000);
  zeros << Eigen::Matrix3Xd::Zero(3, 30000), fromHere();
  write("zeros.pcd", zeros);
  write("target.pcd", fromThere());
  const ProgramRun run = align("zeros.pcd target.pcd --json -");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(says(run,
                   "note: zeros.pcd: 30000 points are left out that lie in one place, "
                   "most of them at (0 0 0): beams without a return?\n"));
  EXPECT_EQ(run.json().at("points_left_out").at("source").at("repeated"), 30000);
  expectPose(run.json(), here_ - there_);
}

TEST_F(Doubts, StraysBeyondAllOthers)
{
  Eigen::Matrix3Xd strays(3, 30001);
  strays << fromHere(), Eigen::Vector3d::Constant(1e30);
  write("stray.pcd", strays);
  write("target.pcd", fromThere());
  for (const char* leaf : {"", " --leaf 0.1"}) {
    const ProgramRun run = align(std::string("stray.pcd target.pcd --json -") + leaf);
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(
        says(run, "note: stray.pcd: 1 point is left out that lies beyond all others"))
        << run.err;
    EXPECT_EQ(run.json().at("points_left_out").at("source").at("stray"), 1);
  }
}

TEST_F(Doubts, ViewpointsThatPointsWereNotSeenFrom)
{
  const Eigen::Vector3d moved(60, -20, 4);
  write("moved.pcd", fromHere().colwise() + moved);
  write("moved.ply", fromHere().colwise() + moved);
  write("target.pcd", fromThere());
  for (const std::string name : {"moved.pcd", "moved.ply"}) {
    const ProgramRun run = align(name + " target.pcd --json -");
    ASSERT_EQ(run.status, 0) << run.err;
    EXPECT_TRUE(says(run,
                     "note: " + name +
                         ": its points were not seen from its viewpoint, (0 0 0), but "
                         "from about ("))
        << run.err;
    const nlohmann::json seen = run.json().at("seen_from").at("source");
    EXPECT_EQ(seen.at("known_by"), "points");
    const auto place = seen.at("place").get<std::vector<double>>();
    EXPECT_LT((Eigen::Vector3d(place.data()) - moved).norm(), 1.0);
    expectPose(run.json(), here_ - there_ - moved);
    // Who says that nobody knows is told nothing.
    const ProgramRun unknown = align(name + " target.pcd --no-viewpoint --json -");
    EXPECT_EQ(unknown.err, "");
    EXPECT_EQ(unknown.json().at("seen_from").at("source").at("known_by"), "unknown");
  }
}

TEST_F(Doubts, UnitsThatDiffer)
{
  write("target.pcd", fromThere());
  for (const double factor : {3.28084, 0.3048, 2.54, 100.0, 1e-3}) {
    write("source.pcd", factor * fromHere());
    const ProgramRun run = align("source.pcd target.pcd");
    EXPECT_NE(run.status, 0) << factor;
    EXPECT_TRUE(says(run, "in the same unit?")) << factor << run.err;
  }
  write("source.pcd", 3.28084 * fromHere());
  EXPECT_TRUE(says(align("source.pcd target.pcd --leaf 0.1"), "the same unit?"));
}

TEST_F(Doubts, FlatClouds)
{
  Eigen::Matrix3Xd floor(3, 10000);
  for (Eigen::Index i = 0; i < floor.cols(); ++i)
    floor.col(i) << 0.05 * static_cast<double>(i % 100),
        0.05 * static_cast<double>(i / 100), 0;
  write("floor.pcd", floor);
  write("target.pcd", fromThere());
  const ProgramRun run = align("floor.pcd target.pcd");
  EXPECT_EQ(run.status, 1);
  EXPECT_TRUE(says(run, "note: floor.pcd: is flat: all its points lie in one plane"))
      << run.err;
  EXPECT_FALSE(says(run, "target.pcd: is flat"));
}

} // namespace
} // namespace pcl_flashreg::cli
