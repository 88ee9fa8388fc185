// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// What the tests of pcl_flashreg_align share: they run the built program as a user
// does, on files that they write into a folder of their own.

#include "io/cloud_io.h"
#include "io/file.h"
#include "io/transform_io.h"
#include "support/made_correspondences.h"
#include "support/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl_flashreg::cli {

namespace fs = std::filesystem;

/** \brief Points on the walls and boxes of a made room of 3 m x 2.4 m x 2 m. */
inline Eigen::Matrix3Xd
roomPoints(std::size_t size, std::uint64_t seed)
{
  // Each row: a corner of a rectangle, then its two edges.
  static const double rectangles[][9] = {{0, 0, 0, 3, 0, 0, 0, 2.4, 0},
                                         {0, 0, 0, 3, 0, 0, 0, 0, 2},
                                         {0, 0, 0, 0, 2.4, 0, 0, 0, 2},
                                         {0.4, 0.3, 0.7, 1.2, 0, 0, 0, 0.6, 0},
                                         {0.4, 0.9, 0, 1.2, 0, 0, 0, 0, 0.7},
                                         {1.6, 0.3, 0, 0, 0.6, 0, 0, 0, 0.7},
                                         {2.2, 1.5, 0.4, 0.5, 0.2, 0, -0.2, 0.5, 0},
                                         {2.2, 1.5, 0, 0.5, 0.2, 0, 0, 0, 0.4},
                                         {0, 1.4, 1.1, 0.5, 0, 0, 0, 0.8, 0},
                                         {0.5, 1.4, 0.9, 0, 0.8, 0, 0, 0, 0.2},
                                         {1.9, 0, 1.2, 0, 0.4, 0.15, 0.7, 0, 0}};
  made::Random random(seed);
  Eigen::Matrix3Xd xyz(3, static_cast<Eigen::Index>(size));
  std::vector<double> areas;
  double total = 0;
  for (const auto& r : rectangles) {
    const Eigen::Vector3d a(r[3], r[4], r[5]), b(r[6], r[7], r[8]);
    total += a.cross(b).norm();
    areas.push_back(total);
  }
  for (auto p : xyz.colwise()) {
    const double pick = random.uniform(0, total);
    std::size_t k = 0;
    while (areas[k] < pick)
      ++k;
    const auto& r = rectangles[k];
    const double u = random.uniform(0, 1), v = random.uniform(0, 1);
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = r[axis] + u * r[3 + axis] + v * r[6 + axis] + 0.003 * random.normal();
  }
  return xyz;
}

/** \brief A cloud of float32 or double coordinates and the given further fields, which
 * get values that tell the points apart. */
inline io::Cloud
cloudOf(const Eigen::Matrix3Xd& xyz,
        io::ScalarType type = io::ScalarType::Float32,
        const std::vector<io::Field>& more = {})
{
  io::Cloud cloud;
  for (const char* name : {"x", "y", "z"})
    cloud.addField(name, type);
  for (const io::Field& field : more)
    cloud.addField(field.name, field.type, field.count);
  cloud.width = static_cast<std::size_t>(xyz.cols());
  cloud.data.resize(cloud.size() * cloud.point_size);
  for (std::size_t i = 0; i < cloud.size(); ++i)
    for (std::size_t f = 0; f < cloud.fields.size(); ++f)
      io::storeValue(
          cloud.point(i),
          cloud.fields[f],
          f < 3 ? xyz(static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(i))
                : static_cast<double>((i * 7 + f) % 251));
  return cloud;
}

/** \brief A folder of its own for every test, and the program in it. */
class CliTest : public ProgramTest {
protected:
  void
  SetUp() override
  {
    ProgramTest::SetUp();
    const Eigen::Isometry3d pose = made::Random(11).pose(2);
    truth_.rotation = pose.linear();
    truth_.translation = pose.translation();
  }

  /** \brief The room, seen twice: target in its own frame, source under the inverse of
   * truth_. No point is in both. */
  void
  writeRoom(const std::string& source, const std::string& target) const
  {
    io::writeCloud(path(source), cloudOf(sourcePoints()));
    io::writeCloud(path(target), cloudOf(roomPoints(kPoints, 2)));
  }

  Eigen::Matrix3Xd
  sourcePoints() const
  {
    return truth_.rotation.transpose() *
           (roomPoints(kPoints, 1).colwise() - truth_.translation);
  }

  /** \brief Runs the program in the folder.
   * \param[in] arguments as they are typed into a shell
   */
  ProgramRun
  align(const std::string& arguments) const
  {
    return runProgram(PCL_FLASHREG_ALIGN, arguments);
  }

  /** \brief Expects a pose within a few millimetres of the truth. */
  void
  expectTruth(const RigidTransform& pose) const
  {
    EXPECT_LT((pose.rotation - truth_.rotation).norm(), 0.03);
    const Eigen::Vector3d middle = truth_.rotation.transpose() *
                                   (Eigen::Vector3d(1.5, 1.2, 1) - truth_.translation);
    EXPECT_LT((pose.toIsometry() * middle - truth_.toIsometry() * middle).norm(), 0.03);
  }

  static RigidTransform
  poseOf(const nlohmann::json& json)
  {
    RigidTransform pose;
    const auto& rows = json.at("transformation");
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j)
        pose.rotation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) =
            rows.at(i).at(j);
      pose.translation[static_cast<Eigen::Index>(i)] = rows.at(i).at(3);
    }
    EXPECT_EQ(rows.at(3), nlohmann::json({0.0, 0.0, 0.0, 1.0}));
    return pose;
  }

  static constexpr std::size_t kPoints = 12000;

  RigidTransform truth_;
};

} // namespace pcl_flashreg::cli
