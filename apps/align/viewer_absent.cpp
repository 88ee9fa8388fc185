// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "viewer.h"

namespace pcl_flashreg::align {

const bool kViewerBuiltIn = false;

void
requireDisplay()
{
}

void
showClouds(const Eigen::Matrix3Xd&, const Eigen::Matrix3Xd&, const RigidTransform&)
{
}

} // namespace pcl_flashreg::align
