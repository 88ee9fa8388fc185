// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/export.h>
#include <pcl_flashreg/feature_matching.h>
#include <pcl_flashreg/point_view.h>

#include <cstddef>
#include <memory>
#include <vector>

namespace pcl_flashreg {

/** \brief How a cloud is described; lengths in its unit. */
struct PCL_FLASHREG_EXPORT FeatureParameters {
  /** \brief One keypoint is kept a voxel of this size; 0 keeps every point. >= 0. */
  double voxel_size = 0.05;

  /** \brief Neighbours within this distance give a point its normal. > 0. */
  double normal_radius = 0.10;

  /** \brief Neighbours within this distance are described. >= normal_radius. */
  double feature_radius = 0.25;

  /** \brief Where the sensor stood: normals point to it. */
  float viewpoint[3] = {0, 0, 0};

  /** \brief Voxel : radius of the normals : radius of the features = 1 : 2 : 5.
   * \param[in] resolution voxel size, in the unit of the cloud, > 0 and finite
   * \throws std::invalid_argument if it is not
   */
  static FeatureParameters
  fromResolution(double resolution);

  /** \brief Checks every field against the range stated with it.
   * \throws std::invalid_argument with the name, the value and the range of the first
   * field that is out of it
   */
  void
  validate() const;
};

/** \brief Wall-clock time of each step in milliseconds. */
struct FeatureTimings {
  double voxel_grid = 0;
  double neighbor_grid = 0;
  double normals = 0;
  /** \brief Simplified point feature histograms: each point's own pairs. */
  double point_histograms = 0;
  /** \brief The neighbours' histograms, weighted and summed up. */
  double feature_histograms = 0;
};

/** \brief Keypoints of a cloud with their normals and descriptors. All arrays have `size`
 * rows, in the order of the voxels (z, then y, then x), or of the points if there are no
 * voxels. */
struct DescribedCloud {
  std::size_t size = 0;
  /** \brief x, y, z. */
  std::vector<float> points;
  /** \brief Unit normals, towards the viewpoint. */
  std::vector<float> normals;
  /** \brief Smallest eigenvalue of the neighbourhood's covariance over their sum. */
  std::vector<float> curvatures;
  /** \brief FPFH, 33 values: three histograms of 11 bins, each summing up to 100. */
  std::vector<float> descriptors;

  FeatureView
  features() const
  {
    return {descriptors.data(), size, 33, 33};
  }
};

/** \brief Downsamples a cloud and describes what is left by Fast Point Feature Histograms
 * (Rusu, Blodow, Beetz, ICRA 2009), as PCL's VoxelGrid, NormalEstimation and FPFHEstimation
 * define them.
 *
 * Points with a coordinate that is not finite are skipped; keypoints without a normal
 * (fewer than three points in reach) or without any pair to describe are left out. The
 * same to the last bit on every SIMD variant and number of threads. Memory: 8 bytes a
 * point and about 500 a keypoint, beside the result; kept for the next call.
 *
 * An object is not to be used by two threads at a time; after a fork(), as Estimator.
 */
class PCL_FLASHREG_EXPORT FeatureExtractor {
public:
  /** \param[in] num_threads CPU threads; 0 takes as many as there are processors
   * \throws std::invalid_argument, BackendError as the Estimator does for
   * PCL_FLASHREG_CPU
   */
  explicit FeatureExtractor(unsigned num_threads = 0);
  ~FeatureExtractor();
  FeatureExtractor(FeatureExtractor&&) noexcept;
  FeatureExtractor&
  operator=(FeatureExtractor&&) noexcept;

  /** \param[in] points the cloud
   * \param[in] parameters see there
   * \param[out] timings of the steps, if not null
   * \throws std::invalid_argument if a parameter, the stride or an index is out of range,
   * if the cloud has more than 2^31 - 1 points, or if the voxels are so small for its
   * extent that 64 bits can't number them
   */
  DescribedCloud
  describe(const PointView& points,
           const FeatureParameters& parameters,
           FeatureTimings* timings = nullptr);

private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

} // namespace pcl_flashreg
