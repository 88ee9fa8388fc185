// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pcl_flashreg::io {

/** \brief A scan and its pose, as files of poses know it. */
struct PosedScan {
  /** \brief What stands for it in a file that knows no names; see numbersOf(). */
  std::string number;
  std::string name;
  RigidTransform pose;
};

/** \brief Of each scan the name of its file without its extension, where all names are
 * numbers (times); else its place in the order, from 0. */
std::vector<std::string>
numbersOf(const std::vector<std::string>& paths);

/** \brief Of the two that are the rotation, the one with a positive real part. */
Eigen::Quaterniond
quaternionOf(const RigidTransform& pose);

/** \brief The fewest digits that make the same double again; 0 has no sign. */
std::string
numberText(double value);

/** \brief tx, ty, tz, qx, qy, qz, qw. */
std::vector<std::string>
poseCells(const RigidTransform& pose);

/** \brief The pose of seven such numbers, of any length of the quaternion that is 1 when rounded
 * to two digits; nothing if they are none. */
std::optional<RigidTransform>
poseOfCells(const double* cells);

/** \brief A name as a row or a comment can hold it. */
std::string
inOneLine(std::string name);

/** \brief A row a scan: number, translation, quaternion (x y z w); comments say which
 * scan that is. */
std::string
formatTum(const std::vector<PosedScan>& scans);

/** \brief A row a scan: the upper three rows of the 4 x 4 matrix. */
std::string
formatKitti(const std::vector<PosedScan>& scans);

/** \brief A row of a file of poses. */
struct NumberedPose {
  /** \brief Its number in the file; of a format that has none, its place in the order. */
  double number = 0;
  RigidTransform pose;
};

/** \brief Reads what formatTum() or formatKitti() wrote, which the length of the rows tells.
 * \throws InputError with the number of the line, if a row is no pose */
std::vector<NumberedPose>
parsePoses(std::string_view text);

/** \brief The pose of each scan: by its number, where all their names are numbers and the poses
 * have them all; else in their order.
 * \throws InputError if they are not as many as the scans then */
std::vector<RigidTransform>
posesOf(const std::vector<std::string>& paths, const std::vector<NumberedPose>& poses);

} // namespace pcl_flashreg::io
