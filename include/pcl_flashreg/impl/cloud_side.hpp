// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>
#include <pcl_flashreg/pair_registration.h>
#include <pcl_flashreg/pcl_front_end.h>

#include <optional>

namespace pcl_flashreg {

/** \brief Who computes keypoints, normals and descriptors. */
enum class FrontEnd {
  /** \brief PairRegistration::makeScan() */
  Native,
  /** \brief computeFpfhWithPcl(): by OpenMP, which GCC's programs can't use in the child
   * of a fork() if the parent has. */
  Pcl
};

namespace detail {

/** \brief One of the two clouds of a FlashRegistration: what the class computed of it,
 * until what that depends on changes. Whoever changes the cloud says so with reset(). */
class CloudSide {
public:
  /** \brief The cloud is another one, or its points are. */
  void
  reset()
  {
    scan_ = Scan();
    fpfh_ = FpfhCloud();
    resolution_ = 0;
  }

  /** \brief The points to use; empty for all of them.
   * \return whether they are others than before */
  bool
  setIndices(const pcl::Indices& indices)
  {
    if (indices == indices_)
      return false;
    indices_ = indices;
    reset();
    return true;
  }

  const pcl::Indices&
  indices() const
  {
    return indices_;
  }

  /** \brief Whether the sensor stood at the cloud's sensor_origin_. */
  void
  setViewpointKnown(bool known)
  {
    if (known != viewpoint_known_)
      reset();
    viewpoint_known_ = known;
  }

  bool
  viewpointKnown() const
  {
    return viewpoint_known_;
  }

  /** \brief The cloud as a registration takes it, and what was made of it before. */
  template <typename PointT>
  ScanInput<float>
  inputFrom(const pcl::PointCloud<PointT>& cloud, const FloatRows<PointT>& rows) const
  {
    ScanInput<float> input;
    input.points = rows.view();
    input.viewpoint = cloud.sensor_origin_.template head<3>().template cast<double>();
    input.viewpoint_known = viewpoint_known_;
    input.made = &scan_;
    return input;
  }

  /** \brief The keypoints that PCL's classes make of the cloud, in its place.
   * \return what it took; 0 where nothing was to be done */
  template <typename PointT>
  FpfhTimings
  describeWithPcl(const pcl::PointCloud<PointT>& cloud,
                  double resolution,
                  unsigned num_threads,
                  ScanInput<float>& input)
  {
    FpfhTimings timings;
    if (resolution != resolution_)
      fpfh_ = computeFpfhWithPcl(cloud, indices_, resolution, num_threads, &timings);
    resolution_ = resolution;
    takeKeypoints(fpfh_, input);
    return timings;
  }

  /** \brief What the registration made of it. */
  template <typename PointT>
  void
  keep(const pcl::PointCloud<PointT>& cloud, const Scan& scan)
  {
    if (scan.points() != scan_.points() && resolution_ == 0)
      fpfh_ = FpfhCloud();
    scan_ = scan;
    header_ = cloud.header;
    sensor_origin_ = cloud.sensor_origin_;
    sensor_orientation_ = cloud.sensor_orientation_;
  }

  const Scan&
  scan() const
  {
    return scan_;
  }

  /** \brief Put together at the first call. */
  const FpfhCloud&
  fpfh() const
  {
    if (fpfh_.points || scan_.empty())
      return fpfh_;
    fpfh_ = toFpfhCloud(scan_);
    for (auto& point : *fpfh_.points)
      point.getVector3fMap() += scan_.shift().cast<float>();
    fpfh_.points->header = header_;
    fpfh_.points->sensor_origin_ = sensor_origin_;
    fpfh_.points->sensor_orientation_ = sensor_orientation_;
    return fpfh_;
  }

private:
  pcl::Indices indices_;
  bool viewpoint_known_ = true;
  Scan scan_;
  /** \brief PCL's, at this resolution, unless that is 0; else of scan_, where somebody
   * has asked for it. */
  double resolution_ = 0;
  mutable FpfhCloud fpfh_;

  pcl::PCLHeader header_;
  Eigen::Matrix<float, 4, 1, Eigen::DontAlign> sensor_origin_;
  Eigen::Quaternion<float, Eigen::DontAlign> sensor_orientation_;
};

} // namespace detail
} // namespace pcl_flashreg
