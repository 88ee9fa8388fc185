// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "scan/cpu/feature_stages.h"

#include <pcl_flashreg/pair_registration.h>

#include <vector>

namespace pcl_flashreg {

/** \brief A ScanInput, checked, without points that are none, in single precision, and
 * shifted where that takes it; what it was made from must stay, and so must this. */
struct PreparedInput {
  /** \throws std::invalid_argument if a stride, a size or an index is out of range */
  template <typename Scalar>
  explicit PreparedInput(const ScanInput<Scalar>& input);
  PreparedInput(const PreparedInput&) = delete;
  PreparedInput&
  operator=(const PreparedInput&) = delete;

  PointView points;
  /** \brief Where the points had to be rounded or shifted. */
  std::vector<float> copy;
  LeftOutPoints left_out;
  /** \brief Indices of the points, where any were left out. */
  std::vector<std::int32_t> kept;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Vector3d viewpoint;
  bool viewpoint_known;
  bool many_viewpoints;
  /** \brief Whether anybody can have looked from so far. */
  bool viewpoint_possible = true;
  GivenNormals normals;
  FeatureView features;
  const Scan* made;
};

extern template PreparedInput::PreparedInput(const ScanInput<float>&);
extern template PreparedInput::PreparedInput(const ScanInput<double>&);

/** \brief What a cloud by itself would be seen at, and how large the middle of it is. */
struct CloudScale {
  double resolution, extent;
};

/** \throws std::invalid_argument as estimateResolution() */
CloudScale
scaleOf(const PointView& points);

/** \brief Makes scans, with threads that it is lent and memory of its own. */
class ScanMaker {
public:
  explicit ScanMaker(ThreadPool& pool)
      : pool_(pool), stages_(cpu::selectKernels(), pool)
  {
  }

  /** \throws std::invalid_argument if the resolution is no length, or too small for the
   * extent of the cloud */
  Scan
  make(const PreparedInput& input,
       double resolution,
       ScanContent content,
       FeatureTimings& timings);

  /** \brief A scan with descriptors as it would be seen at a coarser resolution: from its
   * keypoints and their normals, for matching alone: it knows no viewpoint. In its frame.
   * \param[in] factor by which it is coarser, > 1 */
  Scan
  coarser(const Scan& scan, double factor);

private:
  struct Seen {
    Eigen::Vector3d from;
    ViewpointSource source = ViewpointSource::Unknown;
    /** \brief See Scan::normalsOriented(). */
    bool normals_oriented = true;
  };

  /** \brief Where the surface was seen from, and its normals turned there. */
  Seen
  turnToViewpoint(const PreparedInput& input, double resolution);

  void
  turnToManyViewpoints(double resolution);

  ThreadPool& pool_;
  cpu::FeatureStages stages_;
};

} // namespace pcl_flashreg
