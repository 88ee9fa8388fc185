// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/flash_registration.h>

#include <algorithm>
#include <string>

#include "pcl_fixtures.h"

namespace pcl_flashreg {
namespace made {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using Registration = FlashRegistration<pcl::PointXYZ, pcl::PointXYZ>;

inline const RoomPairXYZ&
room()
{
  static const RoomPairXYZ pair;
  return pair;
}

/** \brief Set up, but not aligned; on copies, which a test may change. */
class FlashRegistrationTest : public testing::Test {
protected:
  FlashRegistrationTest()
  {
    registration.setInputSource(source);
    registration.setInputTarget(target);
    registration.setResolution(room_resolution);
  }

  void
  expectFound()
  {
    EXPECT_TRUE(registration.hasConverged());
    EXPECT_EQ(registration.getStatus(), Status::Ok);
    EXPECT_EQ(registration.getErrorMessage(), "");
    expectPose(registration.getFinalTransformation(), room().T_target_source);
  }

  void
  expectNotFound(const std::string& word)
  {
    EXPECT_FALSE(registration.hasConverged());
    EXPECT_TRUE(registration.getFinalTransformation().isIdentity(0));
    EXPECT_NE(registration.getErrorMessage().find(word), std::string::npos)
        << registration.getErrorMessage();
    EXPECT_TRUE(registration.getInliers().empty());
    EXPECT_TRUE(registration.getInlierCorrespondences().empty());
  }

  void
  alignSilently()
  {
    const Silence silence;
    registration.align(output);
  }

  Cloud::Ptr source{new Cloud(*room().source)};
  Cloud::Ptr target{new Cloud(*room().target)};
  Registration registration;
  Cloud output;
};

/** \brief Largest distance between the transformed source and the output. */
inline double
largestDifference(const Cloud& source, const Cloud& output, const Result& result)
{
  double largest = 0;
  const auto pose = result.T_target_source.toIsometry();
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d moved = pose * source[i].getVector3fMap().cast<double>();
    const Eigen::Vector3d got = output[i].getVector3fMap().cast<double>();
    largest = std::max(largest, (moved - got).norm());
  }
  return largest;
}

} // namespace made
} // namespace pcl_flashreg
