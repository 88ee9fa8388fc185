// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// The native front end against PCL's classes, on clouds of every public data set.

#include "io/cloud_io.h"
#include "io/pcl_cloud.h"
#include "support/datasets.h"

#include <pcl_flashreg/pcl_front_end.h>

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

namespace pcl_flashreg {
namespace {

struct RealCloud {
  const char* file;
  double resolution;
};

void
PrintTo(const RealCloud& cloud, std::ostream* out)
{
  *out << cloud.file << " at " << cloud.resolution;
}

constexpr double CLOSE = 0.05;

/** \brief The direction of least spread, in double precision. */
struct ExactNormal {
  Eigen::Vector3d direction;
  /** \brief Its spread is below nine tenths of the next one's. */
  bool clear;
  /** \brief That one is below a hundredth of the largest: a scan line. PCL's single
   * precision does not resolve the normal there. */
  bool line;
};

ExactNormal
exactNormal(const detail::PointsXYZ& cloud, const pcl::Indices& neighbors)
{
  Eigen::Vector3d mean(0, 0, 0);
  for (const auto i : neighbors)
    mean += cloud[i].getVector3fMap().cast<double>();
  mean /= static_cast<double>(neighbors.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const auto i : neighbors) {
    const Eigen::Vector3d d = cloud[i].getVector3fMap().cast<double>() - mean;
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  const Eigen::Vector3d values = solver.eigenvalues();
  return {solver.eigenvectors().col(0),
          values[0] < 0.9 * values[1] && values[1] > 1e-6 * values[2],
          values[1] < 1e-2 * values[2]};
}

class FrontEnds : public testing::TestWithParam<RealCloud> {
protected:
  void
  SetUp() override
  {
    PCL_FLASHREG_NEEDS_DATA(GetParam().file);
    cloud = *io::toPclCloud(io::coordinates(io::readCloud(datasets::folder() + "/" +
                                                          GetParam().file)))
                 .points;
    native = computeFpfh(cloud, {}, GetParam().resolution);
    ASSERT_GT(native.points->size(), 400u);
  }

  detail::PointsXYZ cloud;
  FpfhCloud native;
};

} // namespace

TEST_P(FrontEnds, AgreeOnKeypointsAndNormals)
{
  const double resolution = GetParam().resolution;
  const auto keypoints =
      detail::downsample(detail::finitePoints(cloud, {}), resolution);
  const auto normals = detail::estimateNormals(keypoints, 2 * resolution, 0);
  pcl::search::KdTree<pcl::PointXYZ> tree;
  tree.setInputCloud(keypoints);
  std::size_t clear = 0, exact = 0, compared = 0, agreeing = 0, at = 0;
  for (std::size_t i = 0; i < native.points->size(); ++i, ++at) {
    // PCL keeps points that have no normal, or nothing to describe.
    const Eigen::Vector3f point = (*native.points)[i].getVector3fMap();
    while (at < keypoints->size() &&
           ((*keypoints)[at].getVector3fMap() - point).norm() > 1e-4 * resolution)
      ++at;
    ASSERT_LT(at, keypoints->size()) << "keypoint " << i << " is none of PCL's";
    pcl::Indices neighbors;
    std::vector<float> distances;
    tree.radiusSearch((*keypoints)[at], 2 * resolution, neighbors, distances);
    const ExactNormal truth = exactNormal(*keypoints, neighbors);
    if (!truth.clear)
      continue;
    const Eigen::Vector3f own = (*native.normals)[i].getNormalVector3fMap();
    ++clear;
    exact += own.cast<double>().cross(truth.direction).norm() < 1e-3 ? 1 : 0;
    if (truth.line)
      continue;
    ++compared;
    const Eigen::Vector3f pcl = (*normals)[at].getNormalVector3fMap();
    agreeing += own.cross(pcl).norm() < 1e-3 && own.dot(pcl) > 0 ? 1 : 0;
  }
  RecordProperty("normals_compared", static_cast<int>(compared));
  RecordProperty("normals_that_differ", static_cast<int>(compared - agreeing));
  EXPECT_GT(static_cast<double>(clear),
            0.9 * static_cast<double>(native.points->size()));
  EXPECT_GE(static_cast<double>(exact), 0.999 * static_cast<double>(clear))
      << clear - exact << " of " << clear << " are not exact";
  EXPECT_GE(static_cast<double>(agreeing), 0.999 * static_cast<double>(compared))
      << compared - agreeing << " of " << compared << " differ";
}

TEST_P(FrontEnds, AgreeOnDescriptors)
{
  // From the same normals: where two are parallel, the last bit of a normal decides
  // which of both points a pair is measured from.
  const auto pcl =
      detail::estimateFpfh(native.points, native.normals, 5 * GetParam().resolution, 0);
  ASSERT_EQ(pcl->size(), native.features->size());
  std::size_t agreeing = 0;
  for (std::size_t i = 0; i < pcl->size(); ++i) {
    float largest = 0;
    for (std::size_t bin = 0; bin < 33; ++bin)
      largest = std::max(
          largest,
          std::abs((*pcl)[i].histogram[bin] - (*native.features)[i].histogram[bin]));
    agreeing += largest < CLOSE ? 1 : 0;
  }
  RecordProperty("descriptors", static_cast<int>(pcl->size()));
  RecordProperty("descriptors_that_differ", static_cast<int>(pcl->size() - agreeing));
  EXPECT_GE(static_cast<double>(agreeing), 0.99 * static_cast<double>(pcl->size()))
      << pcl->size() - agreeing << " of " << pcl->size() << " differ";
}

INSTANTIATE_TEST_SUITE_P(
    DataSets,
    FrontEnds,
    testing::Values(
        RealCloud{"3dmatch/7-scenes-redkitchen/cloud_bin_0.pcd", 0.05},
        RealCloud{"3dmatch/sun3d-hotel_umd-maryland_hotel3/cloud_bin_1.pcd", 0.05},
        RealCloud{"3dmatch/sun3d-home_at-home_at_scan1_2013_jan_1/cloud_bin_0.pcd",
                  0.05},
        RealCloud{"3dmatch_raw_redkitchen/cloud_bin_0.pcd", 0.05},
        RealCloud{"turboreg_kitti_demo/000_pts_src.ply", 1.0},
        RealCloud{"turboreg_kitti_demo/010_pts_dst.ply", 1.0},
        RealCloud{"kitti/00/000000.pcd", 0.5},
        RealCloud{"balm_hilti_lidar/full0.pcd", 0.25},
        RealCloud{"stanford_bunny/bun000.pcd", 0.0025},
        RealCloud{"fast_gicp_pair/251370668.pcd", 0.5},
        RealCloud{"mac_demos/macpp_src.pcd", 0.05},
        RealCloud{"open3d_feature_pair/cloud_bin_0.pcd", 0.05},
        RealCloud{"pcl_data_tutorials/capture0001.pcd", 0.02},
        RealCloud{"pcl_data_tutorials/room_scan1.pcd", 0.1}));

} // namespace pcl_flashreg
