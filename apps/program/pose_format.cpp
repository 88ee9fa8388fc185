// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "pose_format.h"

#include "../io/file.h"
#include "program.h"

namespace pcl_flashreg::program {

const std::map<std::string, PoseFormat> POSE_FORMATS = {{"tum", PoseFormat::Tum},
                                                        {"kitti", PoseFormat::Kitti},
                                                        {"csv", PoseFormat::Csv},
                                                        {"json", PoseFormat::AsJson}};

bool
isOfOneGroup(PoseFormat format)
{
  return format == PoseFormat::Tum || format == PoseFormat::Kitti;
}

PoseFormat
poseFormatOf(const std::string& path)
{
  std::string extension = io::extensionOf(path);
  if (extension == ".txt")
    return PoseFormat::Tum;
  extension.erase(0, 1);
  const auto found = POSE_FORMATS.find(extension);
  if (found == POSE_FORMATS.end())
    throw UsageError(path + ": poses are written as .tum (or .txt), .kitti, .csv or "
                            ".json; --format says which, whatever the name");
  return found->second;
}

} // namespace pcl_flashreg::program
