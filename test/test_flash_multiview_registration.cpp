// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include <pcl_flashreg/flash_multiview_registration.h>

#include "pcl_fixtures.h"

using namespace pcl_flashreg;

namespace {

template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr
toCloud(const std::vector<Eigen::Vector3d>& points)
{
  typename pcl::PointCloud<PointT>::Ptr cloud(new pcl::PointCloud<PointT>);
  for (const Eigen::Vector3d& p : points) {
    PointT point;
    point.getVector3fMap() = p.cast<float>();
    if constexpr (pcl::traits::has_normal<PointT>::value)
      point.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
    if constexpr (pcl::traits::has_color<PointT>::value)
      point.r = 200;
    cloud->push_back(point);
  }
  return cloud;
}

/** \brief A room in six scans, each of a part of it, in a frame of its own. */
struct RoomScans {
  std::vector<std::vector<Eigen::Vector3d>> scans;
  std::vector<Eigen::Isometry3d> T_room_scan;

  RoomScans()
  {
    const Eigen::Vector3d sensor(1.6, 2.0, 1.8);
    const auto add = [&](std::uint64_t seed,
                         const Eigen::Vector3d& from,
                         const Eigen::Vector3d& to) {
      const Eigen::AlignedBox3d seen(from, to);
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      made::Random random(seed);
      pose.rotate(
          Eigen::AngleAxisd(random.uniform(-3, 3), random.inCube(1).normalized()));
      pose.pretranslate(sensor);
      scans.emplace_back();
      const made::Room sampled(seed, 300, 0.004);
      for (const auto& point : sampled.points())
        if (seen.contains(point))
          scans.back().push_back(pose.inverse() * point);
      T_room_scan.push_back(pose);
    };
    const Eigen::Vector3d low(-1, -1, -1), high(4, 4, 4);
    add(1, low, {2.5, 4, 4});
    add(2, {0.3, -1, -1}, high);
    add(3, low, {4, 2, 4});
    add(4, {-1, 0.2, -1}, high);
    add(5, low, {4, 4, 1.7});
    add(6, low, {2.3, 2.2, 4});
  }

  /** \brief How far a cloud's pose in the frame of the first one is off, in the middle of the
   * room, in metres. */
  double
  error(const Eigen::Isometry3d& T_first_scan, std::size_t scan) const
  {
    const Eigen::Vector3d middle(1.5, 1.2, 0.6);
    return (T_room_scan[0] * T_first_scan * T_room_scan[scan].inverse() * middle -
            middle)
        .norm();
  }
};

const RoomScans&
room()
{
  static const RoomScans scans;
  return scans;
}

template <typename PointT>
void
addRoom(FlashMultiviewRegistration<PointT>& registration)
{
  for (const auto& points : room().scans)
    registration.addPointCloud(toCloud<PointT>(points));
  registration.setResolution(made::room_resolution);
}

/** \brief Fails unless all clouds are in one group, where they belong. */
template <typename PointT>
void
expectPlaced(const FlashMultiviewRegistration<PointT>& registration)
{
  ASSERT_TRUE(registration.hasConverged()) << registration.getErrorMessage();
  for (std::size_t i = 0; i < registration.getNumVertices(); ++i) {
    EXPECT_TRUE(registration.isPlaced(i));
    EXPECT_EQ(registration.getGroup(i), 0u);
    const Eigen::Isometry3d pose =
        registration.getResult().scans[i].T_group_scan.toIsometry();
    EXPECT_LT(room().error(pose, i), 0.03) << i;
    EXPECT_TRUE(registration.getTransformation(i).matrix().isApprox(
        pose.matrix().cast<float>(), 1e-6f));
  }
}

template <typename PointT>
class MultiviewPointTypes : public testing::Test {
};
using Types =
    testing::Types<pcl::PointXYZ, pcl::PointXYZI, pcl::PointXYZRGB, pcl::PointNormal>;
TYPED_TEST_SUITE(MultiviewPointTypes, Types);

TYPED_TEST(MultiviewPointTypes, ArePlaced)
{
  FlashMultiviewRegistration<TypeParam> registration;
  addRoom(registration);
  EXPECT_EQ(registration.getNumVertices(), 6u);
  registration.compute();
  expectPlaced(registration);
  const auto all = registration.getConcatenatedCloud();
  std::size_t sum = 0;
  for (const auto& points : room().scans)
    sum += points.size();
  EXPECT_EQ(all->size(), sum);
  EXPECT_EQ(registration.getConcatenatedCloud(1)->size(), 0u);
  if constexpr (pcl::traits::has_color<TypeParam>::value) {
    EXPECT_EQ(all->back().r, 200);
  }
}

class FlashMultiviewRegistrationTest : public testing::Test {
protected:
  using Cloud = pcl::PointCloud<pcl::PointNormal>;

  void
  computeSilently()
  {
    const made::Silence silence;
    registration.compute();
  }

  void
  expectFailure(const std::string& word)
  {
    computeSilently();
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_NE(registration.getErrorMessage().find(word), std::string::npos)
        << registration.getErrorMessage();
    for (std::size_t i = 0; i < registration.getNumVertices(); ++i) {
      EXPECT_FALSE(registration.isPlaced(i));
      EXPECT_TRUE(registration.getTransformation(i).matrix().isIdentity(0));
    }
  }

  FlashMultiviewRegistration<pcl::PointNormal> registration;
};

TEST_F(FlashMultiviewRegistrationTest, MovesClouds)
{
  addRoom(registration);
  registration.compute();
  ASSERT_TRUE(registration.isPlaced(2));
  const Cloud::ConstPtr cloud = registration.getPointCloud(2);
  const Cloud::Ptr moved = registration.getTransformedCloud(2);
  const Eigen::Affine3f pose = registration.getTransformation(2);
  ASSERT_EQ(moved->size(), cloud->size());
  EXPECT_LT(((*moved)[7].getVector3fMap() - pose * (*cloud)[7].getVector3fMap()).norm(),
            1e-5);
  EXPECT_LT(((*moved)[7].getNormalVector3fMap() -
             pose.linear() * (*cloud)[7].getNormalVector3fMap())
                .norm(),
            1e-5);
  EXPECT_LT((moved->sensor_origin_.head<3>() - pose.translation()).norm(), 1e-5);
  EXPECT_LT((moved->sensor_orientation_.toRotationMatrix() - pose.linear()).norm(),
            1e-5);
}

TEST_F(FlashMultiviewRegistrationTest, EstimatesTheResolution)
{
  addRoom(registration);
  registration.setResolution(0);
  EXPECT_EQ(registration.getResolution(), 0);
  registration.compute();
  EXPECT_GT(registration.getResolution(), 0.01);
  EXPECT_LT(registration.getResolution(), 0.5);
  EXPECT_TRUE(registration.isPlaced(0));
}

TEST_F(FlashMultiviewRegistrationTest, CloudsThatBelongNowhereStayApart)
{
  addRoom(registration);
  made::Random random(4);
  std::vector<Eigen::Vector3d> fog;
  for (int i = 0; i < 5000; ++i)
    fog.push_back(random.inCube(4));
  const auto vertex = registration.addPointCloud(toCloud<pcl::PointNormal>(fog));
  const auto empty = registration.addPointCloud(Cloud::Ptr(new Cloud));
  registration.compute();
  EXPECT_EQ(registration.getErrorMessage(), "");
  EXPECT_FALSE(registration.hasConverged());
  for (const auto v : {vertex, empty}) {
    EXPECT_FALSE(registration.isPlaced(v));
    EXPECT_NE(registration.getGroup(v), 0u);
    EXPECT_EQ(registration.getConfidence(v), 0);
    EXPECT_TRUE(registration.getTransformation(v).matrix().isIdentity(0));
  }
  EXPECT_TRUE(registration.isPlaced(0));
  EXPECT_EQ(registration.getConcatenatedCloud(registration.getGroup(vertex))->size(),
            fog.size());
}

TEST_F(FlashMultiviewRegistrationTest, TakesOtherCloudsAfterwards)
{
  addRoom(registration);
  const Cloud::ConstPtr last = registration.getPointCloud(5);
  registration.setPointCloud(5, Cloud::Ptr(new Cloud));
  registration.compute();
  EXPECT_FALSE(registration.isPlaced(5));
  EXPECT_TRUE(registration.isPlaced(4));
  registration.setPointCloud(5, last);
  EXPECT_FALSE(registration.isPlaced(4)) << "no result any more";
  registration.compute();
  expectPlaced(registration);
}

TEST_F(FlashMultiviewRegistrationTest, SettingsReachTheRegistration)
{
  EXPECT_TRUE(registration.getViewpointsKnown());
  EXPECT_EQ(registration.getMinConfidence(), MultiviewOptions().min_confidence);
  EXPECT_FALSE(registration.getSequence());
  addRoom(registration);
  registration.setNumberOfThreads(1);
  registration.setSequence(true);
  registration.setViewpointsKnown(false);
  EXPECT_TRUE(registration.getSequence());
  EXPECT_FALSE(registration.getViewpointsKnown());
  registration.compute();
  ASSERT_FALSE(registration.getResult().edges.empty());
  for (const MapEdge& edge : registration.getResult().edges)
    EXPECT_EQ(edge.agreement.contradicted, 0)
        << "no viewpoint, nothing seen to be empty";
  registration.setMotion(MotionModel::Upright);
  registration.setMaxTilt(0);
  expectFailure("max_tilt");
  registration.setMaxTilt(3);
  registration.setMinConfidence(1.5);
  expectFailure("min_confidence");
}

TEST_F(FlashMultiviewRegistrationTest, SaysWhatIsMissing)
{
  expectFailure("fewer than two clouds");
  registration.addPointCloud(toCloud<pcl::PointNormal>(room().scans[0]));
  expectFailure("fewer than two clouds");
  registration.addPointCloud(toCloud<pcl::PointNormal>(room().scans[1]));
  for (const double bad : {-1.0, std::numeric_limits<double>::quiet_NaN()}) {
    registration.setResolution(bad);
    expectFailure("resolution");
  }
  registration.setResolution(1e-30);
  expectFailure("cloud 0: ");
  registration.setResolution(made::room_resolution);
  registration.compute();
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_EQ(registration.getErrorMessage(), "");
  EXPECT_THROW(registration.getTransformation(2), std::out_of_range);
  EXPECT_THROW(registration.getPointCloud(2), std::out_of_range);
  EXPECT_THROW(registration.getTransformedCloud(2), std::out_of_range);
}

TEST_F(FlashMultiviewRegistrationTest, NoCloudIsAnEmptyOne)
{
  {
    const made::Silence silence;
    registration.addPointCloud(nullptr);
  }
  ASSERT_EQ(registration.getNumVertices(), 1u);
  EXPECT_EQ(registration.getPointCloud(0)->size(), 0u);
  registration.addPointCloud(Cloud::Ptr(new Cloud));
  expectFailure("no cloud has points");
}

} // namespace
