// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "snapshot.h"

#include "../io/file.h"
#include "modules.h"

namespace pcl_flashreg::align {

const bool kSnapshotBuiltIn = true;

void
writeSnapshot(const std::string& path,
              const Eigen::Matrix3Xd& source,
              const Eigen::Matrix3Xd& target,
              const RigidTransform& T_target_source)
{
  const Eigen::Matrix3Xd moved =
      (T_target_source.rotation * source).colwise() + T_target_source.translation;
  std::string png;
  loadSnapshot()(
      {source.data(), moved.data(), source.cols(), target.data(), target.cols()}, png);
  io::writeFile(path, png);
}

} // namespace pcl_flashreg::align
