// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Correspondences of real scans, one to three in a hundred of them right.

#include "simd/kernels.h"
#include "support/datasets.h"
#include "support/made_correspondences.h"

#include <pcl_flashreg/estimator.h>

#include <gtest/gtest.h>

#include <cstdlib>

namespace pcl_flashreg {
namespace {

using datasets::readNumbers;

class KittiPairs : public testing::TestWithParam<const char*> {};

TEST_P(KittiPairs, AreRegistered)
{
  const std::string stem = std::string("turboreg_kitti_demo/") + GetParam();
  PCL_FLASHREG_NEEDS_DATA(stem + "_trans.txt");
  const std::vector<double> source = readNumbers(stem + "_fpfh_kpts_src.txt");
  const std::vector<double> target = readNumbers(stem + "_fpfh_kpts_dst.txt");
  const std::vector<double> truth = readNumbers(stem + "_trans.txt");
  ASSERT_EQ(source.size(), target.size());
  ASSERT_EQ(truth.size(), 16u);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(truth.data());
  const CorrespondenceView<double> view{
      source.data(), target.data(), source.size() / 3};
  const Parameters parameters = Parameters::fromResolution(0.3);

  std::vector<Result> results;
  std::size_t count = 0;
  const cpu::Kernels* const* kernels = cpu::availableKernels(count);
  for (std::size_t i = 0; i < count; ++i)
    for (const unsigned threads : {1u, 2u}) {
      setenv("PCL_FLASHREG_CPU", kernels[i]->name, 1);
      Estimator estimator(BackendKind::Cpu, threads);
      unsetenv("PCL_FLASHREG_CPU");
      for (int run = 0; run < 10; ++run)
        results.push_back(estimator.estimate(view, parameters));
    }
  const RigidTransform& pose = results.front().T_target_source;
  EXPECT_LT(made::rotationError(pose.rotation, T.topLeftCorner<3, 3>()), 5);
  EXPECT_LT((pose.translation - T.topRightCorner<3, 1>()).norm(), 0.6);
  for (const Result& result : results) {
    EXPECT_EQ(result.T_target_source.rotation, pose.rotation);
    EXPECT_EQ(result.T_target_source.translation, pose.translation);
    EXPECT_EQ(result.inliers, results.front().inliers);
  }
}

INSTANTIATE_TEST_SUITE_P(Kitti,
                         KittiPairs,
                         testing::Values("000", "010", "020", "050", "070"));

TEST(MacPair, IsRegistered)
{
  PCL_FLASHREG_NEEDS_DATA("mac_demos/macpp_corr.txt");
  const std::vector<double> rows = readNumbers("mac_demos/macpp_corr.txt");
  const std::vector<double> truth = readNumbers("mac_demos/macpp_GTmat.txt");
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> T(truth.data());
  std::vector<double> source, target;
  for (std::size_t i = 0; i + 6 <= rows.size(); i += 6) {
    source.insert(source.end(), &rows[i], &rows[i] + 3);
    target.insert(target.end(), &rows[i] + 3, &rows[i] + 6);
  }
  const Result result = Estimator().estimate(
      CorrespondenceView<double>{source.data(), target.data(), source.size() / 3});
  EXPECT_LT(
      made::rotationError(result.T_target_source.rotation, T.topLeftCorner<3, 3>()),
      15);
  EXPECT_LT((result.T_target_source.translation - T.topRightCorner<3, 1>()).norm(),
            0.3);
}

} // namespace
} // namespace pcl_flashreg
