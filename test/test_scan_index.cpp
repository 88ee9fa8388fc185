// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// A scan in a map, and the map as a file.

#include "support/made_room.h"
#include "support/made_scans.h"
#include "support/temporary_folder.h"

#include <pcl_flashreg/pair_registration.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <stdexcept>

namespace pcl_flashreg {
namespace {

constexpr double V = 0.05;

/** \brief Points that a ball around a place has, in a frame of their own; all if it is
 * large. */
struct Cut {
  Cut(std::uint64_t seed,
      const Eigen::Vector3d& centre,
      double radius,
      const Eigen::Isometry3d& T_own = Eigen::Isometry3d::Identity())
  {
    const made::Room room(seed, 1200, 0.003);
    for (const Eigen::Vector3d& point : room.points())
      if ((point - centre).norm() < radius)
        made::RoomScans::append(xyz, T_own * point);
  }

  ScanInput<double>
  input() const
  {
    ScanInput<double> result;
    result.points.data = xyz.data();
    result.points.size = xyz.size() / 3;
    return result;
  }

  std::vector<double> xyz;
};

class ScanIndexTest : public FolderTest {
protected:
  static Eigen::Isometry3d
  mapFromScan()
  {
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.rotate(Eigen::AngleAxisd(1.3, Eigen::Vector3d(0.2, 0.4, 0.9).normalized()));
    T.pretranslate(Eigen::Vector3d(1.5, 1.2, 1.4));
    return T;
  }

  static Scan
  makeMap(PairRegistration& registration, double offset = 0)
  {
    Cut room(1, {0, 0, 0}, 100);
    if (offset != 0) {
      const std::vector<double> first = room.xyz;
      for (std::size_t i = 0; i < first.size(); i += 3)
        made::RoomScans::append(room.xyz,
                                {first[i] + offset, first[i + 1], first[i + 2]});
    }
    ScanInput<double> input = room.input();
    input.many_viewpoints = true;
    return registration.makeScan(input, V);
  }

  static const Scan&
  map()
  {
    static PairRegistration registration(BackendKind::Cpu, 2);
    static const Scan scan = makeMap(registration);
    return scan;
  }

  /** \brief A quarter of the room, whose sensor stood in the origin of its frame. */
  static const Scan&
  scan()
  {
    static PairRegistration registration(BackendKind::Cpu, 2);
    static const Cut cut(7, {1.2, 0.7, 0.5}, 0.9, mapFromScan().inverse());
    static const Scan made = [] {
      ScanInput<double> input = cut.input();
      input.viewpoint_known = true;
      return registration.makeScan(input, V);
    }();
    return made;
  }

  static double
  errorOf(const RigidTransform& T)
  {
    const Eigen::Vector3d place(1.2, 0.7, 0.5);
    return (T.toIsometry() * (mapFromScan().inverse() * place) - place).norm();
  }

  static void
  expectSame(const Result& a, const Result& b)
  {
    EXPECT_EQ(a.T_target_source.toMatrix<double>(),
              b.T_target_source.toMatrix<double>());
    EXPECT_EQ(a.confidence, b.confidence);
    EXPECT_EQ(a.inliers, b.inliers);
    EXPECT_EQ(a.information, b.information);
    ASSERT_EQ(a.hypotheses.size(), b.hypotheses.size());
    for (std::size_t i = 0; i < a.hypotheses.size(); ++i)
      EXPECT_EQ(a.hypotheses[i].T_target_source.toMatrix<double>(),
                b.hypotheses[i].T_target_source.toMatrix<double>());
  }

  /** \return what open() complains of; nothing if it does not */
  static std::string
  complaintOf(const std::string& file, bool verify = false)
  {
    try {
      ScanIndex::open(file, verify);
    }
    catch (const ScanFileError& error) {
      return error.what();
    }
    return "";
  }

  void
  write(const std::string& file, const std::string& bytes) const
  {
    std::ofstream(file, std::ios::binary) << bytes;
  }

  static std::string
  bytesOf(const std::string& file)
  {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  PairRegistration registration{BackendKind::Cpu, 2};
};

TEST_F(ScanIndexTest, AScanIsFoundInItsMap)
{
  ASSERT_GT(map().size(), 3 * scan().size());
  const PairResult result = registration.align(scan(), map());
  EXPECT_TRUE(result.pose.converged) << result.pose.confidence;
  EXPECT_LT(errorOf(result.pose.T_target_source), V);
  EXPECT_TRUE(result.pose.evidence.in_map);
  EXPECT_TRUE(result.pose.evidence.has_viewpoints);
  EXPECT_GT(result.pose.evidence.agreement.matched, 0.8) << "of the scan, not of all";
}

TEST_F(ScanIndexTest, TheIndexChangesNothing)
{
  const ScanIndex index = registration.makeIndex(map());
  const Result without = registration.align(scan(), map()).pose;
  expectSame(registration.align(scan(), index).pose, without);
  PairRegistration alone(BackendKind::Cpu, 1);
  expectSame(alone.align(scan(), alone.makeIndex(map())).pose, without);
  PairOptions options;
  options.neighbors = 3;
  expectSame(registration.align(scan(), index, options).pose,
             registration.align(scan(), map(), options).pose);
  options.mutual = true;
  expectSame(registration.align(scan(), index, options).pose,
             registration.align(scan(), map(), options).pose);
  options.resolution = 1.5 * V;
  expectSame(registration.align(scan(), index, options).pose,
             registration.align(scan(), map(), options).pose);
  // One that is no map for the other.
  expectSame(registration.align(map(), index).pose,
             registration.align(map(), map()).pose);
}

/** \brief Rows of [w] and [v], of a motion applied on the left. */
Eigen::Matrix<double, 6, 6>
adjointOf(const RigidTransform& T)
{
  Eigen::Matrix<double, 6, 6> adjoint = Eigen::Matrix<double, 6, 6>::Zero();
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(i), turned = T.rotation * axis;
    adjoint.col(i) << turned, T.translation.cross(turned);
    adjoint.col(3 + i) << Eigen::Vector3d::Zero(), turned;
  }
  return adjoint;
}

TEST_F(ScanIndexTest, AMapIsFoundAroundAScan)
{
  PairOptions options;
  options.parameters.motion = MotionModel::Upright;
  options.parameters.target_gravity = {0, 0, 1};
  const Eigen::Vector3f up = (mapFromScan().linear().transpose().col(2)).cast<float>();
  options.parameters.source_gravity = {up.x(), up.y(), up.z()};
  const PairResult there = registration.align(scan(), map(), options);
  std::swap(options.parameters.source_gravity, options.parameters.target_gravity);
  const PairResult back = registration.align(map(), scan(), options);
  EXPECT_TRUE(back.pose.converged);
  EXPECT_EQ(back.source.size(), map().size());
  EXPECT_EQ(back.pose.inliers, there.pose.inliers);
  EXPECT_EQ(back.pose.confidence, there.pose.confidence);
  ASSERT_EQ(back.matches.size(), there.matches.size());
  EXPECT_EQ(back.matches[3].query, there.matches[3].match);
  EXPECT_EQ(back.matches[3].match, there.matches[3].query);
  const Eigen::Isometry3d product =
      back.pose.T_target_source.toIsometry() * there.pose.T_target_source.toIsometry();
  EXPECT_TRUE(product.isApprox(Eigen::Isometry3d::Identity(), 1e-9));
  const auto adjoint = adjointOf(there.pose.T_target_source);
  EXPECT_TRUE(back.pose.information.isApprox(
      adjoint.transpose() * there.pose.information * adjoint, 1e-9));
}

TEST_F(ScanIndexTest, CorrespondencesAndGuessesHoldBothWays)
{
  const PairResult there = registration.align(scan(), map());
  const Correspondences rows = toCorrespondences(scan(), map(), there.matches);
  Correspondences turned = rows;
  std::swap(turned.source, turned.target);
  PairOptions options;
  options.guess = there.pose.T_target_source;
  const PairResult forth = registration.align(scan(), map(), rows.view(), options);
  RigidTransform back;
  back.rotation = options.guess->rotation.transpose();
  back.translation = -(back.rotation * options.guess->translation);
  options.guess = back;
  const PairResult reverse = registration.align(map(), scan(), turned.view(), options);
  EXPECT_TRUE(forth.pose.converged);
  EXPECT_EQ(forth.pose.inliers, reverse.pose.inliers);
  EXPECT_LT((reverse.pose.T_target_source.toIsometry() *
             forth.pose.T_target_source.toIsometry())
                .translation()
                .norm(),
            1e-6);
}

/** \brief Scans that can't be found are not found, whatever is odd about them. */
TEST_F(ScanIndexTest, OddScansAreNotFound)
{
  const ScanIndex index = registration.makeIndex(map());
  EXPECT_EQ(registration.align(Scan(), index).pose.status,
            Status::TooFewCorrespondences);
  EXPECT_EQ(registration.align(scan(), ScanIndex()).pose.status,
            Status::TooFewCorrespondences);
  // Three keypoints in one place, and three on a line as long as a voxel.
  for (const float step : {0.0f, 0.02f}) {
    std::vector<float> points, descriptors(3 * 33, 1);
    for (int i = 0; i < 3; ++i)
      points.insert(points.end(), {step * static_cast<float>(i), 0, 0});
    ScanInput<float> input;
    input.points.data = points.data();
    input.points.size = 3;
    input.features = {descriptors.data(), 3, 33, 33};
    const Scan odd = registration.makeScan(input, V);
    EXPECT_FALSE(registration.align(odd, index).pose.converged);
    EXPECT_FALSE(registration.align(index.scan(), odd).pose.converged);
  }
}

TEST_F(ScanIndexTest, EqualPlacesAreRivals)
{
  const Scan twice = makeMap(registration, 6.0);
  const PairResult result = registration.align(scan(), twice);
  EXPECT_FALSE(result.pose.converged) << result.pose.confidence;
  EXPECT_GT(result.pose.evidence.rivals, 0.5);
}

TEST_F(ScanIndexTest, IsTheSameOnceItWasSaved)
{
  const ScanIndex index = registration.makeIndex(map());
  const std::string file = path("map.index");
  index.save(file);
  for (const bool verify : {false, true}) {
    const ScanIndex opened = ScanIndex::open(file, verify);
    EXPECT_EQ(opened.scan().serialize(), map().serialize());
    expectSame(registration.align(scan(), opened).pose,
               registration.align(scan(), index).pose);
    EXPECT_GT(opened.bytes(), opened.scan().serialize().size());
    opened.save(path("again.index"));
    EXPECT_EQ(bytesOf(path("again.index")), bytesOf(file));
  }
  // Whoever replaces the file leaves those alone who have it open.
  const ScanIndex opened = ScanIndex::open(file);
  ScanIndex().save(file);
  EXPECT_EQ(opened.scan().serialize(), map().serialize());
  EXPECT_TRUE(ScanIndex::open(file).scan().empty());
}

TEST_F(ScanIndexTest, HoldsViewpointShiftAndOwnDescriptors)
{
  std::vector<double> far = Cut(3, {0, 0, 0}, 100).xyz;
  for (std::size_t i = 0; i < far.size(); i += 3) {
    far[i] += 500000;
    far[i + 1] += 5400000;
  }
  ScanInput<double> input;
  input.points.data = far.data();
  input.points.size = far.size() / 3;
  input.viewpoint = {500001.6, 5400002.0, 1.8};
  input.viewpoint_known = true;
  const Scan geo = registration.makeScan(input, V);
  registration.makeIndex(geo).save(path("geo.index"));
  const ScanIndex opened = ScanIndex::open(path("geo.index"));
  EXPECT_EQ(opened.scan().shift(), geo.shift());
  EXPECT_EQ(opened.scan().viewpoint(), geo.viewpoint());
  expectSame(registration.align(scan(), opened).pose,
             registration.align(scan(), geo).pose);

  std::vector<float> descriptors;
  for (std::size_t i = 0; i < map().size(); ++i)
    descriptors.insert(descriptors.end(), {0, 1, static_cast<float>(i % 7)});
  ScanInput<float> own;
  own.points.data = map().points();
  own.points.size = map().size();
  own.features = {descriptors.data(), map().size(), 3, 3};
  const Scan described = registration.makeScan(own, V);
  registration.makeIndex(described).save(path("own.index"));
  EXPECT_EQ(ScanIndex::open(path("own.index")).scan().serialize(),
            described.serialize());
}

TEST_F(ScanIndexTest, WhatIsNoneIsRefused)
{
  EXPECT_THROW(registration.makeIndex(registration.makeScan(
                   Cut(1, {0, 0, 0}, 100).input(), V, ScanContent::Surface)),
               std::invalid_argument);
  EXPECT_NE(complaintOf(path("none.index")).find(path("none.index") + ": "),
            std::string::npos);
  EXPECT_NE(complaintOf(folder_.string()).find(folder_.string()), std::string::npos);
  write(path("text.index"), "# .PCD v0.7");
  EXPECT_NE(complaintOf(path("text.index")).find("does not begin"), std::string::npos);
  write(path("empty.index"), "");
  EXPECT_NE(complaintOf(path("empty.index")), "");

  registration.makeIndex(map()).save(path("map.index"));
  const std::string good = bytesOf(path("map.index"));
  std::string newer = good;
  newer[8] = 9;
  write(path("newer.index"), newer);
  EXPECT_NE(complaintOf(path("newer.index")).find("format 9"), std::string::npos);
  for (const std::size_t size :
       {std::size_t{5}, std::size_t{63}, std::size_t{300}, good.size() / 2}) {
    write(path("cut.index"), good.substr(0, size));
    EXPECT_NE(complaintOf(path("cut.index")), "") << size;
  }
}

TEST_F(ScanIndexTest, DamageIsFoundOrDoesNoHarm)
{
  const Scan part = map().within({0.6, 0.6, 0.3}, 0.8);
  const Scan small = part.within({0.6, 0.6, 0.3}, 0.35);
  ASSERT_GT(part.size(), 3 * small.size());
  ASSERT_GT(small.size(), 20u);
  registration.makeIndex(part).save(path("map.index"));
  const std::string good = bytesOf(path("map.index"));
  std::size_t harmless = 0;
  for (std::size_t byte = 0; byte < good.size();
       byte += byte < 1000 ? 3 : good.size() / 97) {
    std::string flipped = good;
    flipped[byte] = static_cast<char>(flipped[byte] ^ 0x55);
    write(path("bad.index"), flipped);
    EXPECT_NE(complaintOf(path("bad.index"), true), "") << byte;
    try {
      registration.align(small, ScanIndex::open(path("bad.index")));
      ++harmless;
    }
    // A length that is none, where the file looks sound.
    catch (const std::exception&) {
    }
  }
  EXPECT_GT(harmless, 0u);
}

TEST_F(ScanIndexTest, PartsOfAScanAreScans)
{
  const Eigen::Vector3d centre(1, 1, 0.5);
  const Scan part = map().within(centre, 0.7);
  ASSERT_GT(part.size(), 0u);
  ASSERT_LT(part.size(), map().size());
  std::size_t inside = 0;
  for (std::size_t i = 0; i < map().size(); ++i) {
    if ((map().point(i) - centre).norm() > 0.7)
      continue;
    const float* const row = part.features().data + inside * 33;
    EXPECT_EQ(part.point(inside), map().point(i));
    EXPECT_TRUE(std::equal(row, row + 33, map().features().data + i * 33));
    ++inside;
  }
  EXPECT_EQ(part.size(), inside);
  EXPECT_EQ(part.spacing(), map().spacing());
  EXPECT_TRUE(map().within(centre, 0).empty());
  EXPECT_EQ(map().within(centre, 100).serialize(), map().serialize());
}

TEST_F(ScanIndexTest, NormalsOfAMapPointToWhereOneStands)
{
  // A room with a table in it, from inside: walls, floor and ceiling face the middle.
  std::vector<double> xyz;
  made::Random random(5);
  for (int i = 0; i < 60000; ++i) {
    const Eigen::Vector3d at(
        random.uniform(0, 5), random.uniform(0, 4), random.uniform(0, 2.6));
    Eigen::Vector3d wall = at;
    const int side = i % 6;
    wall[side / 2] = side % 2 == 0 ? 0 : Eigen::Vector3d(5, 4, 2.6)[side / 2];
    made::RoomScans::append(xyz, wall);
  }
  ScanInput<double> input;
  input.points.data = xyz.data();
  input.points.size = xyz.size() / 3;
  input.many_viewpoints = true;
  // What nobody believes: far outside.
  input.viewpoint = {40, -30, 9};
  const Scan room = registration.makeScan(input, V);
  EXPECT_FALSE(room.viewpoint());
  std::size_t inwards = 0;
  for (std::size_t i = 0; i < room.size(); ++i)
    inwards += Eigen::Map<const Eigen::Vector3f>(room.normals() + 3 * i)
                   .cast<double>()
                   .dot(Eigen::Vector3d(2.5, 2, 1.3) - room.point(i)) > 0;
  EXPECT_GT(static_cast<double>(inwards), 0.99 * static_cast<double>(room.size()));
  PairRegistration alone(BackendKind::Cpu, 1);
  EXPECT_EQ(alone.makeScan(input, V).serialize(), room.serialize());
}

} // namespace
} // namespace pcl_flashreg
