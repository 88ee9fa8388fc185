// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cuda/estimation/caller_memory.h"

#include <algorithm>

namespace pcl_flashreg {
namespace cuda {
namespace {

cudaStream_t
streamOf(const DeviceCorrespondences& correspondences)
{
  return static_cast<cudaStream_t>(correspondences.stream);
}

} // namespace

CorrespondenceView<float>
CallerMemory::read(const DeviceCorrespondences& from)
{
  const std::size_t n = from.size;
  points_.reserve(7 * n);
  float* const source = points_.data();
  float* const target = source + 3 * n;
  float* const ranks = target + 3 * n;
  const auto fetch = [&](float* to, const float* values, std::size_t count) {
    PCL_FLASHREG_CUDA(cudaMemcpyAsync(
        to, values, count * sizeof(float), cudaMemcpyDefault, stream_.get()));
  };
  // What else the caller has under way is none of our business.
  written_.record(streamOf(from));
  stream_.waitFor(written_);
  if (n > 0) {
    fetch(source, from.source_xyz, 3 * n);
    fetch(target, from.target_xyz, 3 * n);
    if (from.ranks)
      fetch(ranks, from.ranks, n);
  }
  stream_.synchronize();
  return {source, target, n, from.ranks ? ranks : nullptr};
}

void
CallerMemory::leavePose(const float T_target_source[POSE],
                        const DeviceCorrespondences& asked)
{
  pose_.reserve(POSE);
  // The one before may be on its way still.
  if (pose_under_way_)
    pose_left_.synchronize();
  pose_under_way_ = false;
  std::copy_n(T_target_source, POSE, pose_.data());
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(asked.T_target_source,
                                    pose_.data(),
                                    POSE * sizeof(float),
                                    cudaMemcpyDefault,
                                    streamOf(asked)));
  pose_left_.record(streamOf(asked));
  pose_under_way_ = true;
}

} // namespace cuda
} // namespace pcl_flashreg
