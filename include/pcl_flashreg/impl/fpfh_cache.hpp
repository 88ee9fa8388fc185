// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <pcl_flashreg/fpfh_features.h>
#include <pcl_flashreg/impl/lazy_workers.hpp>
#include <pcl_flashreg/pcl_front_end.h>

#include <optional>

namespace pcl_flashreg {

/** \brief Who computes keypoints, normals and descriptors. */
enum class FrontEnd {
  /** \brief computeFpfh() */
  Native,
  /** \brief computeFpfhWithPcl() */
  Pcl
};

namespace detail {

/** \brief The descriptors of one cloud, computed again only where what they depend on
 * has changed. Whoever changes the cloud says so with reset(). */
class FpfhCache {
public:
  /** \brief The cloud is another one, or its points are. */
  void
  reset()
  {
    resolution_ = 0;
    estimate_.reset();
  }

  /** \brief The points to use; empty for all of them. */
  void
  setIndices(const pcl::Indices& indices)
  {
    if (indices == indices_)
      return;
    indices_ = indices;
    reset();
  }

  template <typename PointT>
  double
  estimatedResolution(const pcl::PointCloud<PointT>& cloud)
  {
    if (!estimate_)
      estimate_ = estimateResolution(cloud, indices_);
    return *estimate_;
  }

  /** \return what it took; 0 where nothing was to be done */
  template <typename PointT>
  FpfhTimings
  update(const pcl::PointCloud<PointT>& cloud,
         double resolution,
         FrontEnd front_end,
         LazyWorkers& workers)
  {
    FpfhTimings timings;
    if (resolution == resolution_ && front_end == front_end_)
      return timings;
    if (front_end == FrontEnd::Pcl)
      fpfh_ = computeFpfhWithPcl(
          cloud, indices_, resolution, workers.numThreads(), &timings);
    else
      fpfh_ = computeFpfh(cloud, indices_, resolution, workers.extractor(), &timings);
    resolution_ = resolution;
    front_end_ = front_end;
    return timings;
  }

  const FpfhCloud&
  fpfh() const
  {
    return fpfh_;
  }

private:
  FpfhCloud fpfh_;
  pcl::Indices indices_;
  /** \brief Of fpfh_; 0 if that is not up to date. */
  double resolution_ = 0;
  FrontEnd front_end_ = FrontEnd::Native;
  std::optional<double> estimate_;
};

} // namespace detail
} // namespace pcl_flashreg
