// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "cuda/estimation/call.cuh"
#include "cuda/support/memory.h"
#include "cuda/support/stream.h"

namespace pcl_flashreg {
namespace dense {

/** \brief The sums of an alignment over the inliers of one block. */
struct PartialSums {
  double sums[16];
  unsigned inliers;
};

/** \brief What the host asks for after a round. */
struct Round {
  unsigned inliers;
  /** \brief Whether they determine a next pose. */
  bool aligned;
};

/** \brief Stage 7, TurboReg's way: the best hypothesis alone, in rounds that the host starts
 * one by one, since it looks at the number of inliers in between. */
class Refinement {
public:
  /** \brief Leaves the refined pose as the one that is listed: Call::listed,
   * Call::listed_inliers.
   * \throws BackendError */
  void
  run(const cuda::Call& call, const cuda::Stream& stream);

  std::size_t
  deviceBytes() const
  {
    return poses_.bytes() + partial_sums_.bytes() + round_.bytes();
  }

private:
  Round
  measure(const cuda::Call& call, Pose* pose, const cuda::Stream& stream);

  /** \brief The pose before each round. */
  cuda::DeviceBuffer<Pose> poses_;
  cuda::DeviceBuffer<PartialSums> partial_sums_;
  cuda::DeviceBuffer<Round> round_;
  cuda::PinnedBuffer<Round> host_round_;
};

} // namespace dense
} // namespace pcl_flashreg
