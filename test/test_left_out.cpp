// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Points that are none: beams without a return, and strays.

#include "scan/left_out.h"
#include "support/made_scans.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <limits>

namespace pcl_flashreg {
namespace {

constexpr double NONE = std::numeric_limits<double>::quiet_NaN();

const made::RoomScans&
room()
{
  static const made::RoomScans scans;
  return scans;
}

/** \brief The source with points added to it, among the others. */
std::vector<double>
sourceWith(const Eigen::Vector3d& place, double share)
{
  const std::size_t size = room().source.size() / 3;
  const auto added =
      static_cast<std::size_t>(share / (1 - share) * static_cast<double>(size));
  std::vector<double> xyz;
  std::size_t done = 0;
  for (std::size_t i = 0; i < size; ++i) {
    xyz.insert(xyz.end(), &room().source[3 * i], &room().source[3 * i] + 3);
    for (; done * size < added * (i + 1); ++done)
      made::RoomScans::append(xyz, place);
  }
  return xyz;
}

PairResult
align(const std::vector<double>& source)
{
  PairRegistration registration(BackendKind::Cpu, 2);
  return registration.align(made::RoomScans::inputOf(source, room().source_viewpoint),
                            room().targetInput());
}

TEST(LeftOut, BeamsWithoutAReturnChangeNothing)
{
  const PairResult clean = align(room().source);
  ASSERT_TRUE(clean.pose.converged);
  EXPECT_EQ(clean.source_left_out.repeated, 0u);
  const double largest_float = std::numeric_limits<float>::max();
  for (const double value : {0.0, 1e6, 1e30, largest_float, -10000.0})
    for (const double share : {0.02, 0.6, 0.95}) {
      const std::vector<double> source =
          sourceWith(Eigen::Vector3d::Constant(value), share);
      const PairResult result = align(source);
      EXPECT_EQ(result.resolution, clean.resolution) << value << ' ' << share;
      EXPECT_EQ(result.source.serialize(), clean.source.serialize());
      EXPECT_EQ(result.pose.confidence, clean.pose.confidence);
      EXPECT_EQ(result.source_left_out.repeated,
                (source.size() - room().source.size()) / 3);
      EXPECT_EQ(result.source_left_out.stray, 0u);
      EXPECT_EQ(result.source_left_out.place, Eigen::Vector3d::Constant(value));
      EXPECT_EQ(result.target_left_out.repeated, 0u);
    }
}

/** \brief What is left out of points in one place that comes before all others, and of
 * others. */
std::size_t
repeatedOf(std::size_t in_one_place, std::size_t others)
{
  std::vector<double> xyz(3 * in_one_place, -1.0);
  xyz.insert(xyz.end(),
             room().source.begin(),
             room().source.begin() + static_cast<std::ptrdiff_t>(3 * others));
  const BasicPointView<double> points{xyz.data(), xyz.size() / 3, 3};
  std::vector<std::int32_t> kept;
  const LeftOutPoints left_out = findLeftOut(points, kept);
  EXPECT_EQ(kept.size(), left_out.repeated > 0 ? others : 0);
  return left_out.repeated;
}

TEST(LeftOut, AHundredInOnePlaceAreNoSurface)
{
  for (const std::size_t others : {0, 1, 900, 3000}) {
    EXPECT_EQ(repeatedOf(100, others), 100u) << others;
    EXPECT_EQ(repeatedOf(99, others), 0u) << others;
  }
}

TEST(LeftOut, StraysChangeNothing)
{
  const PairResult clean = align(room().source);
  std::vector<double> source = room().source;
  made::RoomScans::append(source, {1e30, 1e30, 1e30});
  made::RoomScans::append(source, {0, -5e7, 0});
  made::RoomScans::append(source, {NONE, 0, 0});
  const PairResult result = align(source);
  EXPECT_EQ(result.source.serialize(), clean.source.serialize());
  EXPECT_EQ(result.source_left_out.stray, 2u);
  EXPECT_EQ(result.source_left_out.repeated, 0u);
}

TEST(LeftOut, ZerosInAGeoReferencedCloudDoNotCostItsPrecision)
{
  const Eigen::Vector3d utm(5e5, 4e6, 300);
  std::vector<double> source = room().source;
  for (std::size_t i = 0; i < source.size(); ++i)
    source[i] += utm[static_cast<Eigen::Index>(i % 3)];
  const Scan clean =
      PairRegistration(BackendKind::Cpu, 1)
          .makeScan(made::RoomScans::inputOf(source, room().source_viewpoint + utm),
                    0.1);
  made::RoomScans::append(source, Eigen::Vector3d::Zero());
  const Scan with_zero =
      PairRegistration(BackendKind::Cpu, 1)
          .makeScan(made::RoomScans::inputOf(source, room().source_viewpoint + utm),
                    0.1);
  EXPECT_EQ(with_zero.serialize(), clean.serialize());
}

TEST(LeftOut, PointsOnACoarseGridStay)
{
  std::vector<double> xyz;
  for (int i = 0; i < 4000; ++i)
    made::RoomScans::append(xyz, Eigen::Vector3d(i % 5, i / 5 % 5, i / 25 % 2));
  PairRegistration registration(BackendKind::Cpu, 1);
  const ScanInput<double> input = made::RoomScans::inputOf(xyz, {2, 2, 9});
  PairOptions options;
  options.resolution = 1;
  EXPECT_EQ(registration.align(input, input, options).source_left_out.repeated, 0u);
}

TEST(LeftOut, NumbersOfTheCallersPointsStay)
{
  // Keypoints with descriptors of the caller's: origins() say which points they are.
  std::vector<double> xyz;
  for (int i = 0; i < 300; ++i)
    made::RoomScans::append(xyz, Eigen::Vector3d::Zero());
  xyz.insert(xyz.end(), room().source.begin(), room().source.end());
  std::vector<float> descriptors(xyz.size() / 3);
  for (std::size_t i = 0; i < descriptors.size(); ++i)
    descriptors[i] = static_cast<float>(i);
  ScanInput<double> input = made::RoomScans::inputOf(xyz, room().source_viewpoint);
  input.features = {descriptors.data(), descriptors.size(), 1, 1};
  const Scan scan = PairRegistration(BackendKind::Cpu, 1).makeScan(input, 0.1);
  ASSERT_EQ(scan.size(), room().source.size() / 3);
  EXPECT_EQ(scan.origins()[0], 300);
  EXPECT_EQ(scan.features().data[0], 300);
}

} // namespace
} // namespace pcl_flashreg
