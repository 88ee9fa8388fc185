// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Where a cloud was seen from: what its points say to what was stated.

#include "scan/cpu/visibility.h"
#include "support/made_scans.h"
#include "support/made_sensor.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace pcl_flashreg {
namespace {

constexpr double V = 0.1;
const Eigen::Vector3d HERE(3.0, 2.8, 1.5), THERE(5.2, 3.6, 1.4);

using Points = std::vector<Eigen::Vector3d>;

/** \brief Points in a frame of their own, and what is said of where they were seen from. */
class Seen {
public:
  Seen(const Points& points,
       const Eigen::Isometry3d& frame,
       const Eigen::Vector3d& stated)
      : stated_(stated)
  {
    for (const Eigen::Vector3d& point : points)
      made::RoomScans::append(xyz_, frame * point);
  }

  ScanInput<double>
  input() const
  {
    return made::RoomScans::inputOf(xyz_, stated_);
  }

  Scan
  scan(unsigned threads = 2) const
  {
    return PairRegistration(BackendKind::Cpu, threads).makeScan(input(), V);
  }

private:
  std::vector<double> xyz_;
  Eigen::Vector3d stated_;
};

const Points&
fromHere()
{
  static const Points points = made::Hall::seenFrom(HERE, 30000, 1);
  return points;
}

const Points&
fromThere()
{
  static const Points points = made::Hall::seenFrom(THERE, 30000, 2);
  return points;
}

Eigen::Isometry3d
frameAt(const Eigen::Vector3d& translation, double turn = 0.7)
{
  Eigen::Isometry3d frame = Eigen::Isometry3d(
      Eigen::AngleAxisd(turn, Eigen::Vector3d(0.1, -0.2, 1).normalized()));
  frame.pretranslate(translation);
  return frame;
}

TEST(Viewpoint, ThatIsTrueIsKept)
{
  for (const double off : {0.0, 0.3}) {
    const Eigen::Vector3d stated = HERE + Eigen::Vector3d(off, 0, 0);
    const Scan scan = Seen(fromHere(), Eigen::Isometry3d::Identity(), stated).scan();
    EXPECT_EQ(scan.viewpointSource(), ViewpointSource::Stated) << off;
    EXPECT_EQ(*scan.viewpoint(), stated);
  }
}

TEST(Viewpoint, OfPointsThatSomebodyMovedIsFoundFromThem)
{
  const Eigen::Vector3d directions[] = {
      {1, 0, 0}, {0, -1, 0}, {-1, 1, 0.2}, {0.1, 0.3, -1}};
  for (const double distance : {12.0, 40.0, 300.0, 3000.0, 1e6})
    for (const Eigen::Vector3d& direction : directions) {
      const Eigen::Isometry3d frame = frameAt(distance * direction.normalized());
      const Scan scan = Seen(fromHere(), frame, Eigen::Vector3d::Zero()).scan();
      ASSERT_EQ(scan.viewpointSource(), ViewpointSource::Points) << frame.translation();
      EXPECT_LT((*scan.viewpoint() - frame * HERE).norm(), 1.0) << frame.translation();
      // All but what is seen edge-on is turned to where the sensor was.
      std::size_t turned = 0;
      for (std::size_t i = 0; i < scan.size(); ++i) {
        const Eigen::Map<const Eigen::Vector3f> normal(scan.normals() + 3 * i);
        turned += normal.cast<double>().dot(frame * HERE - scan.point(i)) > 0 ? 1 : 0;
      }
      EXPECT_GT(static_cast<double>(turned), 0.95 * static_cast<double>(scan.size()));
    }
}

TEST(Viewpoint, OfTheOriginDoesNotHarmPairsAwayFromIt)
{
  PairRegistration registration(BackendKind::Cpu, 2);
  for (const double distance : {0.0, 5.0, 12.0, 40.0, 300.0, 3000.0}) {
    const Eigen::Isometry3d source_frame = frameAt({distance, 1, 0.3}, 0.4);
    const Eigen::Isometry3d target_frame = frameAt({-1, distance, 0.1}, -2.0);
    const Seen source(fromHere(), source_frame, Eigen::Vector3d::Zero());
    const Seen target(fromThere(), target_frame, Eigen::Vector3d::Zero());
    const PairResult result = registration.align(source.input(), target.input());
    EXPECT_TRUE(result.pose.converged) << distance << ' ' << result.pose.confidence;
    const Eigen::Vector3d middle(4, 3, 1);
    const auto& pose = result.pose.T_target_source;
    EXPECT_LT((pose.rotation * (source_frame * middle) + pose.translation -
               target_frame * middle)
                  .norm(),
              0.1)
        << distance;
  }
}

TEST(Viewpoint, ThatIsThePoseOfTheScanIsNotBelieved)
{
  // The points are in the sensor's frame, which stood elsewhere in the world.
  const Eigen::Isometry3d to_sensor = Eigen::Isometry3d(Eigen::Translation3d(-HERE));
  const Scan scan = Seen(fromHere(), to_sensor, {40, -25, 3}).scan();
  ASSERT_EQ(scan.viewpointSource(), ViewpointSource::Points);
  EXPECT_LT(scan.viewpoint()->norm(), 1.0);
}

TEST(Viewpoint, OfAMergedMapIsNone)
{
  // Rooms side by side, of which no place sees more than one.
  Points map;
  for (const double x : {0.0, 8.3, 16.6, 24.9})
    for (const Eigen::Vector3d& point : fromHere())
      map.push_back(point + Eigen::Vector3d(x, 0, 0));
  const Seen merged(map, Eigen::Isometry3d::Identity(), Eigen::Vector3d(60, 20, 0));
  EXPECT_FALSE(merged.scan().viewpoint());
  EXPECT_EQ(merged.scan().viewpointSource(), ViewpointSource::Unknown);
  EXPECT_FALSE(merged.scan().normalsOriented());
  EXPECT_FALSE(Scan::deserialize(merged.scan().serialize()).normalsOriented());
}

TEST(Viewpoint, IsNotLookedForWhereNobodyStatedOne)
{
  Seen seen(fromHere(), frameAt({40, 0, 0}), Eigen::Vector3d::Zero());
  ScanInput<double> input = seen.input();
  input.viewpoint_known = false;
  const Scan scan = PairRegistration(BackendKind::Cpu, 1).makeScan(input, V);
  EXPECT_EQ(scan.viewpointSource(), ViewpointSource::Unknown);
  // Nor are normals turned to where nobody was.
  EXPECT_TRUE(scan.normalsOriented());
  EXPECT_TRUE(Scan::deserialize(scan.serialize()).normalsOriented());
  const Eigen::Vector3d sensor = frameAt({40, 0, 0}) * HERE;
  std::size_t turned = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const Eigen::Map<const Eigen::Vector3f> normal(scan.normals() + 3 * i);
    turned += normal.cast<double>().dot(sensor - scan.point(i)) > 0 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(turned), 0.95 * static_cast<double>(scan.size()));
}

/** \brief Far from the origin, where the origin is no viewpoint. */
Scan
geoReferencedScan(const Points& points, double resolution)
{
  const Eigen::Isometry3d frame(Eigen::Translation3d(5e5, 4e6, 300));
  const Seen seen(points, frame, Eigen::Vector3d::Zero());
  return PairRegistration(BackendKind::Cpu, 2).makeScan(seen.input(), resolution);
}

TEST(Viewpoint, OfAGeoReferencedCloudIsFoundFromFewKeypointsToo)
{
  const Eigen::Vector3d sensor = Eigen::Vector3d(5e5, 4e6, 300) + HERE;
  for (const double resolution : {0.1, 1.0, 2.0}) {
    const Scan scan = geoReferencedScan(fromHere(), resolution);
    ASSERT_EQ(scan.viewpointSource(), ViewpointSource::Points) << scan.size();
    EXPECT_LT((*scan.viewpoint() - sensor).norm(), 1.0) << scan.size();
  }
  EXPECT_LT(geoReferencedScan(fromHere(), 2.0).size(), 50u);
}

TEST(Viewpoint, OfAGeoReferencedCloudWithoutASurfaceIsNone)
{
  const Scan scan = geoReferencedScan({{1, 1, 1}, {3, 2, 1}}, V);
  EXPECT_EQ(scan.viewpointSource(), ViewpointSource::Unknown);
  EXPECT_FALSE(scan.viewpoint());
}

TEST(Viewpoint, IsTheSameOnAnyNumberOfThreads)
{
  const Seen seen(fromHere(), frameAt({40, 3, 1}), Eigen::Vector3d::Zero());
  const std::string one = seen.scan(1).serialize();
  EXPECT_EQ(one, seen.scan(2).serialize());
  EXPECT_EQ(one, seen.scan(5).serialize());
  EXPECT_EQ(Scan::deserialize(one).viewpointSource(), ViewpointSource::Points);
}

/** \brief Two walls one behind the other, the nearer one half as wide. */
cpu::Visibility
twoWalls()
{
  std::vector<cpu::SurfaceElement> elements;
  for (int y = 0; y < 40; ++y)
    for (int z = 0; z < 20; ++z) {
      const float along = 0.1f * static_cast<float>(y),
                  up = 0.1f * static_cast<float>(z);
      elements.push_back({{4, along, up}, {1, 0, 0}, 0, true});
      if (y < 20)
        elements.push_back({{3, along, up}, {-1, 0, 0}, 0, true});
    }
  const std::size_t size = elements.size();
  return {std::move(elements), size, 0.1f};
}

TEST(Visibility, CountsWhatIsHidden)
{
  const cpu::Visibility walls = twoWalls();
  const std::size_t all = walls.size();
  // From far in front half of the farther wall is hidden, a third of all.
  EXPECT_NEAR(walls.hiddenShare({-200, 1, 1}, all), 1.0 / 3, 0.05);
  // From behind all of the nearer one is.
  EXPECT_NEAR(walls.hiddenShare({200, 1, 1}, all), 1.0 / 3, 0.05);
  EXPECT_NEAR(walls.hiddenShare({-200, 1e3, 1}, all), 0, 0.01);
  // Between them none.
  EXPECT_LT(walls.hiddenShare({3.5, 3.5, 1}, all), 0.02);
  EXPECT_LT(walls.hiddenShare({3.5, 0.5, 1}, all), 0.02);
}

TEST(Visibility, WhatIsNotSolidHidesNothing)
{
  std::vector<cpu::SurfaceElement> elements = twoWalls().elements();
  for (cpu::SurfaceElement& element : elements)
    element.solid = element.point.x() > 3.5f;
  const std::size_t size = elements.size();
  const cpu::Visibility walls(std::move(elements), size, 0.1f);
  EXPECT_EQ(walls.hiddenShare({-200, 1, 1}, size), 0);
}

TEST(Visibility, ThinningTellsWhereRaysCameFrom)
{
  std::vector<cpu::SurfaceElement> elements;
  const Eigen::Vector3f sensor(0.5f, 2, 1);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      cpu::SurfaceElement element{
          {0.1f * static_cast<float>(x), 0.1f * static_cast<float>(y), 0}, {0, 0, 1}};
      const float range = (element.point - sensor).norm();
      element.log_count = std::log(1e4f * sensor.z() / range / (range * range));
      elements.push_back(element);
    }
  const std::size_t size = elements.size();
  cpu::Visibility floor(elements, size, 0.1f);
  EXPECT_NEAR(floor.thinning(sensor, size), 1, 1e-3);
  EXPECT_LT(floor.thinning({3.5f, 2, 1}, size), 0);
  for (cpu::SurfaceElement& element : elements)
    element.log_count = 2;
  EXPECT_EQ(cpu::Visibility(elements, size, 0.1f).thinning(sensor, size), 0);
}

} // namespace
} // namespace pcl_flashreg
