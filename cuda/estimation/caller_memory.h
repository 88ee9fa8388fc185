// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/support/memory.h"
#include "cuda/support/stream.h"

#include <pcl_flashreg/estimator.h>

namespace pcl_flashreg {
namespace cuda {

/** \brief What goes between the host and device memory of the caller's. The verdict needs
 * coordinates on the host, and the preparation, which rounds them, is the host's: so they are
 * fetched, 28 bytes a correspondence, where 24 go back. */
class CallerMemory {
public:
  /** \return holds until the next call */
  CorrespondenceView<float>
  read(const DeviceCorrespondences& correspondences);

  void
  leavePose(const float T_target_source[16], const DeviceCorrespondences& asked);

private:
  static constexpr std::size_t POSE = 16;

  Stream stream_;
  Event written_, pose_left_;
  bool pose_under_way_ = false;
  PinnedBuffer<float> points_, pose_;
};

} // namespace cuda
} // namespace pcl_flashreg
