// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// What pcl_flashreg_map reads and writes, by itself.

#include "io/error.h"
#include "io/pose_io.h"
#include "map/graph.h"
#include "program/natural_order.h"
#include "map/relation_row.h"
#include "support/made_correspondences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace pcl_flashreg::map {
namespace {

TEST(NaturalOrder, countsNumbersAsNumbers)
{
  const std::vector<std::string> sorted{"",
                                        "1",
                                        "01",
                                        "2.pcd",
                                        "10.pcd",
                                        "99999999999999999999999",
                                        "100000000000000000000000",
                                        "a",
                                        "a0",
                                        "a00",
                                        "a0b",
                                        "a1",
                                        "scan_2.pcd",
                                        "scan_10.pcd",
                                        "scan_10_2",
                                        "scan_10_10",
                                        "scan_a"};
  // "1" and "01" count as much: the text decides.
  EXPECT_TRUE(program::naturallyBefore("01", "1"));
  for (std::size_t i = 0; i < sorted.size(); ++i)
    for (std::size_t j = 0; j < sorted.size(); ++j) {
      const bool swapped = (i == 1 && j == 2) || (i == 2 && j == 1);
      EXPECT_EQ(program::naturallyBefore(sorted[i], sorted[j]), swapped ? j < i : i < j)
          << sorted[i] << ' ' << sorted[j];
    }
}

RigidTransform
somePose(std::uint64_t seed)
{
  const Eigen::Isometry3d pose = made::Random(seed).pose(2);
  RigidTransform result;
  result.rotation = pose.linear();
  result.translation = pose.translation();
  return result;
}

TEST(RelationRow, isTheSameToTheLastBit)
{
  ScanRelation relation;
  relation.target = 3;
  relation.source = 17;
  relation.overruled_viewpoints = true;
  for (const std::uint64_t seed : {1, 2, 3})
    relation.poses.push_back(
        {somePose(seed), 1.0 / (2.0 + static_cast<double>(seed)), 7});
  relation.poses[1].T_target_source.translation = {-0.0, 1e-310, 1e300};
  const ScanRelation again =
      relationFromCells(io::splitCsv(io::joinCsv(relationCells(relation))));
  EXPECT_EQ(again.target, 3u);
  EXPECT_EQ(again.source, 17u);
  EXPECT_TRUE(again.overruled_viewpoints);
  ASSERT_EQ(again.poses.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const RelativePose &a = relation.poses[i], &b = again.poses[i];
    EXPECT_EQ(a.probability, b.probability);
    EXPECT_EQ(a.inliers, b.inliers);
    EXPECT_EQ(a.T_target_source.rotation, b.T_target_source.rotation);
    EXPECT_EQ(a.T_target_source.translation, b.T_target_source.translation);
  }
  EXPECT_TRUE(std::signbit(again.poses[1].T_target_source.translation[0]));
  relation.poses.clear();
  EXPECT_TRUE(relationFromCells(relationCells(relation)).poses.empty());
}

TEST(RelationRow, refusesWhatIsNone)
{
  const std::string pose = "0.5 7 1 0 0 0 0 1 0 0 0 0 1 0";
  EXPECT_EQ(relationFromCells({"0", "1", "0", pose + ';' + pose}).poses.size(), 2u);
  for (const batch::Cells& cells : {batch::Cells{"0", "1", "0"},
                                    {"0", "-1", "0", pose},
                                    {"0", "1", "yes", pose},
                                    {"0", "1", "0", pose + " 1"},
                                    {"0", "1", "0", pose + ";1"},
                                    {"0", "1", "0", "0.5 7 1 0 0 0 0 1 0 0 0 0 1 nan"},
                                    {"0", "1", "0", "0.5 x 1 0 0 0 0 1 0 0 0 0 1 0"}})
    EXPECT_THROW(relationFromCells(cells), io::InputError) << cells.back();
}

/** \brief Half the chi-square of a small motion, by our convention: left, about the target's
 * origin, rotation first. */
double
chiSquare(const InformationMatrix& information,
          const Eigen::Matrix<double, 6, 1>& motion)
{
  return motion.dot(information * motion);
}

TEST(Graph, informationIsG2os)
{
  MapEdge edge;
  edge.T_target_source = somePose(4);
  made::Random random(8);
  Eigen::Matrix<double, 6, 6> factor;
  for (Eigen::Index i = 0; i < 36; ++i)
    factor(i) = random.normal();
  edge.information = factor * factor.transpose();
  // A vertex that is a little off, as g2o sees it: the error is the measurement's inverse
  // times the estimate, its translation and the imaginary part of its quaternion.
  const Eigen::Isometry3d measured = edge.T_target_source.toIsometry();
  const Eigen::Vector3d turn = 1e-6 * Eigen::Vector3d(0.3, -0.5, 0.8),
                        shift = 1e-6 * Eigen::Vector3d(-0.7, 0.2, 0.4);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(shift) * Eigen::AngleAxisd(turn.norm(), turn.normalized());
  const Eigen::Isometry3d off = measured.inverse() * motion * measured;
  Eigen::Matrix<double, 6, 1> error, ours;
  error << off.translation(), Eigen::Quaterniond(off.linear()).vec();
  ours << turn, shift;
  const double expected = chiSquare(edge.information, ours);
  EXPECT_NEAR(
      chiSquare(informationForG2o(edge), error), expected, 1e-4 * std::abs(expected));
  const InformationMatrix information = informationForG2o(edge);
  EXPECT_TRUE(information.isApprox(information.transpose(), 1e-12));
}

TEST(Poses, quaternionsHaveAPositiveRealPart)
{
  for (std::uint64_t seed = 1; seed < 40; ++seed) {
    const RigidTransform pose = somePose(seed);
    const Eigen::Quaterniond q = io::quaternionOf(pose);
    EXPECT_GE(q.w(), 0);
    EXPECT_TRUE(q.toRotationMatrix().isApprox(pose.rotation, 1e-12));
  }
  EXPECT_EQ(io::numberText(-0.0), "0");
  EXPECT_EQ(io::numberText(0.1), "0.1");
}

TEST(PoseFiles, whatIsWrittenIsRead)
{
  std::vector<io::PosedScan> posed;
  for (const std::uint64_t seed : {1, 2, 3})
    posed.push_back({std::to_string(10 * seed), "scan", somePose(seed)});
  for (const bool is_tum : {true, false}) {
    const auto read =
        io::parsePoses(is_tum ? io::formatTum(posed) : io::formatKitti(posed));
    ASSERT_EQ(read.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(read[i].number, is_tum ? 10 * (i + 1) : i);
      EXPECT_TRUE(read[i].pose.rotation.isApprox(posed[i].pose.rotation, 1e-12));
      EXPECT_EQ(read[i].pose.translation, posed[i].pose.translation);
    }
  }
}

TEST(PoseFiles, scansHavePosesByNumberOrInOrder)
{
  std::vector<io::NumberedPose> poses;
  for (const double number : {3.5, 1.5, 2.5})
    poses.push_back({number, {}}), poses.back().pose.translation.x() = number;
  const auto placesOf = [&](const std::vector<std::string>& paths) {
    std::vector<double> places;
    for (const RigidTransform& pose : io::posesOf(paths, poses))
      places.push_back(pose.translation.x());
    return places;
  };
  using Places = std::vector<double>;
  EXPECT_EQ(placesOf({"a/1.5.pcd", "a/3.5.pcd"}), (Places{1.5, 3.5}));
  EXPECT_EQ(placesOf({"a/1.50.pcd", "b/2.5.ply", "3.5.bin"}), (Places{1.5, 2.5, 3.5}));
  // Not all of these numbers are there, and these are none.
  EXPECT_EQ(placesOf({"1.5.pcd", "2.5.pcd", "4.pcd"}), (Places{3.5, 1.5, 2.5}));
  EXPECT_EQ(placesOf({"a.pcd", "b.pcd", "c.pcd"}), (Places{3.5, 1.5, 2.5}));
  EXPECT_THROW(placesOf({"a.pcd", "b.pcd"}), io::InputError);
  EXPECT_THROW(placesOf({"1.5.pcd", "4.pcd"}), io::InputError);
}

} // namespace
} // namespace pcl_flashreg::map
