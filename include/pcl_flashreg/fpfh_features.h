// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/feature_extractor.h>

#include <pcl/pcl_base.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

namespace pcl_flashreg {

/** \brief Keypoints of a cloud (one a voxel), their normals and FPFH descriptors; same
 * size and order. All pointers are null until something was computed. */
struct FpfhCloud {
  /** \brief Frame and unit of the cloud that they come from. */
  pcl::PointCloud<pcl::PointXYZ>::Ptr points;
  /** \brief Towards the cloud's sensor_origin_. */
  pcl::PointCloud<pcl::Normal>::Ptr normals;
  pcl::PointCloud<pcl::FPFHSignature33>::Ptr features;
};

/** \brief Wall-clock time of each step in milliseconds. */
struct FpfhTimings {
  double voxel_grid = 0;
  double normals = 0;
  double features = 0;
};

/** \brief Downsamples a cloud and describes what is left by Fast Point Feature
 * Histograms: voxel : radius of the normals : radius of the features = 1 : 2 : 5.
 *
 * Points with a coordinate that is not finite are skipped, whatever is_dense says;
 * voxels without a finite normal or descriptor (too few neighbours) are left out.
 * Normals point to the cloud's sensor_origin_. The same on every number of threads.
 * \param[in] cloud any point type with x, y, z
 * \param[in] indices points of the cloud to use; empty for all of them
 * \param[in] resolution voxel size, in the unit of the cloud, > 0 and finite
 * \param[in] num_threads CPU threads; 0 takes as many as there are processors
 * \param[out] timings of the three steps, if not null
 * \return possibly without any point, never with null pointers
 * \throws std::invalid_argument if the resolution is not > 0 and finite; if it is so
 * small for the extent of the cloud that 64 bits can't number the voxels; if an index
 * is not one of the cloud
 */
template <typename PointT>
FpfhCloud
computeFpfh(const pcl::PointCloud<PointT>& cloud,
            const pcl::Indices& indices,
            double resolution,
            unsigned num_threads = 0,
            FpfhTimings* timings = nullptr);

/** \brief The same with threads and memory that are kept for the next cloud.
 * \throws std::invalid_argument as above */
template <typename PointT>
FpfhCloud
computeFpfh(const pcl::PointCloud<PointT>& cloud,
            const pcl::Indices& indices,
            double resolution,
            FeatureExtractor& extractor,
            FpfhTimings* timings = nullptr);

/** \brief estimateResolution() of resolution.h for a cloud of PCL's.
 * \param[in] cloud any point type with x, y, z
 * \param[in] indices points of the cloud to use; empty for all of them
 * \throws std::invalid_argument if there are fewer than two distinct finite points; if
 * an index is not one of the cloud
 */
template <typename PointT>
double
estimateResolution(const pcl::PointCloud<PointT>& cloud,
                   const pcl::Indices& indices = {});

/** \brief estimateVoxelSize() of resolution.h for a cloud of PCL's.
 * \param[in] cloud any point type with x, y, z
 * \param[in] indices points of the cloud to use; empty for all of them
 * \throws std::invalid_argument as estimateResolution()
 */
template <typename PointT>
double
estimateVoxelSize(const pcl::PointCloud<PointT>& cloud,
                  const pcl::Indices& indices = {});

} // namespace pcl_flashreg

#include <pcl_flashreg/impl/fpfh_features.hpp>
