// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>

namespace pcl_flashreg {

/** \brief computeFpfh() by pcl::VoxelGrid, pcl::NormalEstimationOMP and
 * pcl::FPFHEstimationOMP: the alternative to FeatureExtractor, and what that is compared
 * with.
 *
 * It keeps keypoints that have a normal but no neighbour to describe, with a descriptor
 * of zeros.
 * \throws std::invalid_argument as computeFpfh(); if there are more than 2^31 voxels,
 * which pcl::VoxelGrid can't number
 */
template <typename PointT>
FpfhCloud
computeFpfhWithPcl(const pcl::PointCloud<PointT>& cloud,
                   const pcl::Indices& indices,
                   double resolution,
                   unsigned num_threads = 0,
                   FpfhTimings* timings = nullptr);

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/pcl_front_end.hpp>
