// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// FlashRegistration with the usual point types, mixed ones, and one that PCL doesn't
// know.

#include <pcl_flashreg/correspondence_rejector_flashreg.h>
#include <pcl_flashreg/flash_registration.h>

#include <pcl/kdtree/impl/kdtree_flann.hpp>

#include "pcl_fixtures.h"

/** \brief Of a program's own. */
struct PointOwn {
  PCL_ADD_POINT4D;
  double stamp;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
};
POINT_CLOUD_REGISTER_POINT_STRUCT(
    PointOwn, (float, x, x)(float, y, y)(float, z, z)(double, stamp, stamp))

using namespace pcl_flashreg;

namespace {

template <typename Source, typename Target>
struct Types {
  using PointSource = Source;
  using PointTarget = Target;
};

template <typename Pair>
class PointTypes : public testing::Test {
};

using Pairs = testing::Types<Types<pcl::PointXYZ, pcl::PointXYZ>,
                             Types<pcl::PointXYZI, pcl::PointXYZI>,
                             Types<pcl::PointXYZRGB, pcl::PointXYZRGB>,
                             Types<pcl::PointNormal, pcl::PointNormal>,
                             Types<pcl::PointXYZ, pcl::PointNormal>,
                             Types<pcl::PointXYZRGBA, pcl::PointXYZI>,
                             Types<PointOwn, PointOwn>,
                             Types<PointOwn, pcl::PointXYZ>>;
TYPED_TEST_SUITE(PointTypes, Pairs);

} // namespace

TYPED_TEST(PointTypes, AreRegistered)
{
  using PointSource = typename TypeParam::PointSource;
  using PointTarget = typename TypeParam::PointTarget;
  const made::RoomPair<PointSource, PointTarget> pair;
  FlashRegistration<PointSource, PointTarget> registration;
  registration.setResolution(made::room_resolution);
  registration.setInputSource(pair.source);
  registration.setInputTarget(pair.target);
  pcl::PointCloud<PointSource> output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  made::expectPose(registration.getFinalTransformation(), pair.T_target_source);
  EXPECT_GT(registration.getInliers().size(), pair.source->size() / 2);
  ASSERT_EQ(output.size(), pair.source->size());
  const Eigen::Vector3f last = pair.source->back().getVector3fMap();
  const Eigen::Vector4f moved =
      registration.getFinalTransformation() * last.homogeneous();
  EXPECT_LT((moved - output.back().getVector4fMap()).norm(), 1e-4);
}

TEST(PointTypesOutput, KeepsTheOtherFields)
{
  const made::RoomPair<PointOwn, PointOwn> pair;
  for (std::size_t i = 0; i < pair.source->size(); ++i)
    (*pair.source)[i].stamp = 1e9 + static_cast<double>(i);
  FlashRegistration<PointOwn, PointOwn> registration;
  registration.setResolution(made::room_resolution);
  registration.setInputSource(pair.source);
  registration.setInputTarget(pair.target);
  pcl::PointCloud<PointOwn> output;
  registration.align(output);
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_EQ(output[17].stamp, 1e9 + 17);
}

TEST(PointTypesOutput, HasItsNormalsRotated)
{
  const made::RoomPair<pcl::PointNormal, pcl::PointXYZ> pair;
  for (auto& point : *pair.source)
    point.getNormalVector3fMap() = Eigen::Vector3f::UnitX();
  FlashRegistration<pcl::PointNormal, pcl::PointXYZ> registration;
  registration.setResolution(made::room_resolution);
  registration.setInputSource(pair.source);
  registration.setInputTarget(pair.target);
  pcl::PointCloud<pcl::PointNormal> output;
  registration.align(output);
  const Eigen::Vector3f expected =
      registration.getFinalTransformation().topLeftCorner<3, 1>();
  EXPECT_LT((output[5].getNormalVector3fMap() - expected).norm(), 1e-5);
  EXPECT_GT((output[5].getNormalVector3fMap() - Eigen::Vector3f::UnitX()).norm(), 0.1);
}

TEST(PointTypesRejector, TakesAnOwnPointType)
{
  CorrespondenceRejectorFlashReg<PointOwn> rejector;
  EXPECT_TRUE(rejector.requiresSourcePoints() && rejector.requiresTargetPoints());
}
