// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/result.h>

#include <Eigen/Geometry>

#include <string>
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

} // namespace pcl_flashreg::io
