// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The layouts of data sets: what is read from good trees, what is said of bad ones.

#include "evaluate/datasets/data_set.h"
#include "evaluate_support.h"

#include <algorithm>

namespace pcl_flashreg::evaluate {
namespace {

class EvaluateDatasets : public EvaluateTest {
protected:
  DataSet
  open(const std::string& name = "") const
  {
    return openDataSet(path(name), options_);
  }

  std::string
  complaint(const std::string& name = "") const
  {
    return complaintOf([&] { open(name); });
  }

  static void
  expectPose(const RigidTransform& pose, const Eigen::Isometry3d& truth)
  {
    EXPECT_TRUE(pose.rotation.isApprox(truth.linear(), 1e-6));
    EXPECT_LT((pose.translation - truth.translation()).norm(), 1e-6);
  }

  DataSetOptions options_;
  Eigen::Isometry3d pose_ = made::Random(3).pose(2);
};

std::string
asRow(std::string matrix)
{
  std::replace(matrix.begin(), matrix.end(), ' ', '\t');
  std::replace(matrix.begin(), matrix.end(), '\n', '\t');
  matrix.pop_back();
  return matrix;
}

TEST_F(EvaluateDatasets, listOfPairs)
{
  const std::string row = asRow(matrixText(pose_));
  write("pairs.tsv",
        "#dataset\tsplit\nRooms\tpublic\tkitchen/a.ply\tkitchen/b.ply\t\t\t" + row +
            "\nRooms\tpublic\tx.ply\ty.ply\tc_{src,dst}.txt\thard\t" + row + "\n");
  const DataSet data = open("pairs.tsv");
  ASSERT_EQ(data.pairs.size(), 2u);
  EXPECT_EQ(data.root, path());
  EXPECT_EQ(data.pairs[0].dataset, "Rooms");
  EXPECT_EQ(data.pairs[0].scene, "kitchen");
  EXPECT_EQ(data.pairs[0].source, "kitchen/a.ply");
  EXPECT_EQ(data.pairs[0].target, "kitchen/b.ply");
  EXPECT_EQ(data.pairs[0].correspondences, "");
  EXPECT_EQ(data.pairs[1].correspondences, "c_{src,dst}.txt");
  expectPose(data.pairs[1].T_target_source, pose_);
}

TEST_F(EvaluateDatasets, badListsNameTheLine)
{
  write("short.tsv", "#\nRooms\tpublic\ta.ply\tb.ply\n");
  EXPECT_EQ(
      complaint("short.tsv").find(path("short.tsv") + ": line 2: found 4 columns"), 0u)
      << complaint("short.tsv");
  std::string row = asRow(matrixText(pose_));
  row.replace(row.find('\t'), 1, "x\t");
  write("word.tsv", "Rooms\tpublic\ta.ply\tb.ply\t\t\t" + row + "\n");
  EXPECT_EQ(complaint("word.tsv").find(path("word.tsv") + ": line 1: "), 0u);
  EXPECT_NE(complaint("absent.tsv").find("no such file"), std::string::npos);
}

TEST_F(EvaluateDatasets, threeDMatchWithBenchmarks)
{
  writeFragments("fragments/kitchen");
  const std::string entry = "0\t1\t60\n" + matrixText(pose_);
  write("benchmarks/3DMatch/kitchen/gt.log", entry);
  write("benchmarks/3DLoMatch/kitchen/gt.log", entry + entry);
  write("benchmarks/3DLoMatch/kitchen/gt.info", "0 1 60\n");
  const DataSet data = open();
  ASSERT_EQ(data.pairs.size(), 3u);
  EXPECT_EQ(data.pairs[0].dataset, "3DLoMatch");
  EXPECT_EQ(data.pairs[2].dataset, "3DMatch");
  EXPECT_EQ(data.pairs[2].scene, "kitchen");
  EXPECT_EQ(data.pairs[2].target, "fragments/kitchen/cloud_bin_0.pcd");
  EXPECT_EQ(data.pairs[2].source, "fragments/kitchen/cloud_bin_1.pcd");
  expectPose(data.pairs[2].T_target_source, pose_);
  EXPECT_EQ(data.leaf, 0.05);
}

TEST_F(EvaluateDatasets, threeDMatchWithEvaluationFolders)
{
  writeFragments("set/kitchen");
  write("set/kitchen-evaluation/gt.log", "0 1 60\n" + matrixText(pose_));
  const DataSet data = open("set");
  ASSERT_EQ(data.pairs.size(), 1u);
  EXPECT_EQ(data.pairs[0].dataset, "set");
  EXPECT_EQ(data.pairs[0].scene, "kitchen");
  EXPECT_EQ(data.pairs[0].source, "kitchen/cloud_bin_1.pcd");
}

TEST_F(EvaluateDatasets, badLogsNameFileAndLine)
{
  const std::string good = "0 1 2\n" + matrixText(pose_);
  writeFragments("kitchen");
  const std::string log = path("kitchen/gt.log");
  write("kitchen/gt.log", good + "0 one 2\n" + matrixText(pose_));
  EXPECT_EQ(complaint().find(log + ": line 6: expected 'i j n'"), 0u) << complaint();
  write("kitchen/gt.log", good + "0 1 2\n1 0 0 0\n");
  EXPECT_EQ(complaint().find(log + ": line 6: the file ends within a matrix"), 0u)
      << complaint();
  write("kitchen/gt.log", good + "0 1 2\n2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  EXPECT_EQ(complaint().find(log + ": line 6: is no rigid transform"), 0u)
      << complaint();
  write("kitchen/gt.log", good + "0 7 2\n" + matrixText(pose_));
  EXPECT_EQ(complaint().find(log + ": line 6: "), 0u) << complaint();
  EXPECT_NE(complaint().find("cloud_bin_7"), std::string::npos);
  write("kitchen/gt.log", good);
  write("office/gt.log", good);
  EXPECT_NE(complaint().find("no folder office"), std::string::npos) << complaint();
}

class EvaluateKitti : public EvaluateDatasets {
protected:
  /** \brief A car that drives along the camera's z axis.
   * \param[in] steps metres from each frame to the next
   */
  void
  writeSequence(const std::string& name, const std::vector<double>& steps) const
  {
    std::ostringstream poses;
    double z = 0;
    for (std::size_t i = 0; i <= steps.size(); ++i) {
      poses << "1 0 0 0 0 1 0 0 0 0 1 " << z << '\n';
      std::string frame = std::to_string(i);
      frame.insert(0, 6 - frame.size(), '0');
      write("sequences/" + name + "/velodyne/" + frame + ".bin", std::string(16, '\0'));
      z += i < steps.size() ? steps[i] : 0;
    }
    write("poses/" + name + ".txt", poses.str());
    // The lidar's x is the camera's z.
    write("sequences/" + name + "/calib.txt",
          "P0: 1 0 0 0 0 1 0 0 0 0 1 0\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  }
};

TEST_F(EvaluateKitti, pairsAreThoseOfTheLiterature)
{
  // From 0: 4, 8 and 12 m, so the last one within 10 m is 2; the next pair begins at 3.
  writeSequence("08", {4, 4, 4, 4, 4, 4, 4});
  options_.sequences = {8};
  const DataSet data = open();
  ASSERT_EQ(data.pairs.size(), 2u);
  EXPECT_EQ(data.bin_fields, 4u) << "is not left to what the values tell";
  EXPECT_EQ(data.pairs[0].source, "sequences/08/velodyne/000000.bin");
  EXPECT_EQ(data.pairs[0].target, "sequences/08/velodyne/000002.bin");
  EXPECT_EQ(data.pairs[1].source, "sequences/08/velodyne/000003.bin");
  EXPECT_EQ(data.pairs[1].target, "sequences/08/velodyne/000005.bin");
  EXPECT_EQ(data.pairs[0].dataset, "KITTI");
  EXPECT_EQ(data.pairs[0].scene, "08");
  // Eight metres on, what was ahead is nearer, along the lidar's x.
  EXPECT_TRUE(data.pairs[0].T_target_source.rotation.isIdentity(1e-9));
  EXPECT_LT(
      (data.pairs[0].T_target_source.translation - Eigen::Vector3d(-8, 0, 0)).norm(),
      1e-9);
  EXPECT_EQ(data.leaf, 0.3);
  EXPECT_EQ(data.criterion.max_rotation, 5);
  EXPECT_EQ(data.criterion.max_translation, 0.6);
}

TEST_F(EvaluateKitti, partnersAreLookedForWithin100Frames)
{
  // 0.05 m a frame never make 10 m in 100 frames; then the car speeds up.
  std::vector<double> steps(150, 0.05);
  steps.insert(steps.end(), 10, 6.0);
  writeSequence("09", steps);
  options_.sequences = {9};
  const DataSet data = open();
  ASSERT_FALSE(data.pairs.empty());
  // 52 is the first frame whose window (to 151) sees 10 m: 98 * 0.05 + 6 = 10.9.
  EXPECT_EQ(data.pairs[0].source, "sequences/09/velodyne/000052.bin");
  EXPECT_EQ(data.pairs[0].target, "sequences/09/velodyne/000150.bin");
}

TEST_F(EvaluateKitti, theWrongPoseIsLeftOut)
{
  // The pairs 0 - 2, 3 - 4, 5 - 6 ... 13 - 14, and 15 - 58.
  std::vector<double> steps(2, 4.0);
  steps.insert(steps.end(), 13, 9.9);
  steps.insert(steps.end(), 43, 0.1);
  steps.insert(steps.end(), 2, 9.9);
  writeSequence("08", steps);
  writeSequence("10", steps);
  options_.sequences = {8, 10};
  std::size_t in_08 = 0, in_10 = 0;
  for (const Pair& pair : open().pairs) {
    (pair.scene == "08" ? in_08 : in_10) += 1;
    EXPECT_NE(pair.source, "sequences/08/velodyne/000015.bin");
  }
  EXPECT_EQ(in_08 + 1, in_10);
}

TEST_F(EvaluateKitti, badTreesNameFileAndLine)
{
  writeSequence("08", {4, 4, 4, 4});
  options_.sequences = {8};
  write("poses/08.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1\n");
  EXPECT_EQ(complaint().find(path("poses/08.txt") + ": line 2: "), 0u) << complaint();
  writeSequence("08", {4, 4, 4, 4});
  fs::remove(path("sequences/08/velodyne/000002.bin"));
  EXPECT_NE(complaint().find("000002.bin is not there"), std::string::npos)
      << complaint();
  write("sequences/08/calib.txt", "P0: 1\n");
  EXPECT_NE(complaint().find("calib.txt: has no line that begins with Tr:"),
            std::string::npos)
      << complaint();
  options_.sequences = {9};
  EXPECT_NE(complaint().find("sequences/09/calib.txt: no such file"), std::string::npos)
      << complaint();
}

TEST_F(EvaluateDatasets, turboRegFolders)
{
  write("demo/000_fpfh_kpts_src.txt", "0 0 0\n");
  write("demo/000_fpfh_kpts_dst.txt", "0 0 0\n");
  write("demo/000_trans.txt", matrixText(pose_));
  const DataSet data = open("demo");
  ASSERT_EQ(data.pairs.size(), 1u);
  EXPECT_EQ(data.pairs[0].dataset, "demo");
  EXPECT_EQ(data.pairs[0].correspondences, "000_fpfh_kpts_{src,dst}.txt");
  EXPECT_EQ(data.pairs[0].source, "000_fpfh_kpts_src.txt");
  expectPose(data.pairs[0].T_target_source, pose_);
  write("demo/000_trans.txt", "1 0 0\n");
  EXPECT_EQ(complaint("demo").find(path("demo/000_trans.txt") + ": "), 0u);
}

TEST_F(EvaluateDatasets, macFolders)
{
  writeMacFolder("3DMatch/all_fpfh/kitchen", 3, 10);
  write("3DMatch/all_fcgf/kitchen/a+b@corr_fcgf.txt", "0 0 0 0 0 0\n");
  write("3DMatch/all_fcgf/kitchen/a+b@GTmat_fcgf.txt", matrixText(pose_));
  const DataSet data = open();
  ASSERT_EQ(data.pairs.size(), 4u);
  EXPECT_EQ(data.pairs[0].dataset, "3DMatch/all_fcgf");
  EXPECT_EQ(data.pairs[0].scene, "kitchen");
  EXPECT_EQ(data.pairs[0].source, "3DMatch/all_fcgf/kitchen/a");
  EXPECT_EQ(data.pairs[0].target, "3DMatch/all_fcgf/kitchen/b");
  EXPECT_EQ(data.pairs[0].correspondences,
            "3DMatch/all_fcgf/kitchen/a+b@corr_fcgf.txt");
  expectPose(data.pairs[0].T_target_source, pose_);
  EXPECT_EQ(data.pairs[1].dataset, "3DMatch/all_fpfh");
  // The authors' list, where there is one, chooses.
  write("3DMatch/all_fpfh/kitchen/dataload.txt", "cloud_bin_101+cloud_bin_102\n");
  const DataSet listed = open();
  ASSERT_EQ(listed.pairs.size(), 2u);
  EXPECT_EQ(listed.pairs[1].source, "3DMatch/all_fpfh/kitchen/cloud_bin_101");
}

TEST_F(EvaluateDatasets, unknownLayoutsAreNamed)
{
  write("some/where.txt", "1 2 3\n");
  EXPECT_EQ(complaint("some").find(path("some") + ": holds none of gt.log"), 0u);
  EXPECT_NE(complaint("none").find("there is no such file or folder"),
            std::string::npos);
}

} // namespace
} // namespace pcl_flashreg::evaluate
