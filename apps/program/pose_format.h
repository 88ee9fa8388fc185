// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <map>
#include <string>

namespace pcl_flashreg::program {

/** \brief How poses are written. */
enum class PoseFormat {
  /** \brief Rows of number, translation, quaternion (x y z w). */
  Tum,
  /** \brief Rows of the upper three rows of a matrix. */
  Kitti,
  /** \brief A row a scan, with names, groups and confidences. */
  Csv,
  AsJson
};

/** \brief What --format takes. */
extern const std::map<std::string, PoseFormat> POSE_FORMATS;

/** \brief Whether a file of that format holds one group: its rows have one frame, and do
 * not say which. */
bool
isOfOneGroup(PoseFormat format);

/** \brief The format that an extension stands for: .tum, .txt, .kitti, .csv, .json.
 * \throws UsageError if it stands for none
 */
PoseFormat
poseFormatOf(const std::string& path);

} // namespace pcl_flashreg::program
