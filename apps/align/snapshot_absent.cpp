// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "snapshot.h"

namespace pcl_flashreg::align {

const bool kSnapshotBuiltIn = false;

void
writeSnapshot(const std::string&,
              const Eigen::Matrix3Xd&,
              const Eigen::Matrix3Xd&,
              const RigidTransform&)
{
}

} // namespace pcl_flashreg::align
