// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 6: every hypothesis is scored on all correspondences.
//
// A thread holds four poses in registers and goes through a piece of the correspondences
// in shared memory, which all threads read at the same place: one such read serves four
// residuals. No residual is ever stored; a thread adds its sums to the scores at the end.
//
// N = 7000, 4000 hypotheses: 28 M residuals of about 20 instructions.

#include "cuda/estimation/verification.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "cuda/estimation/residual_test.cuh"

namespace pcl_flashreg {
namespace cuda {
namespace {

constexpr unsigned THREADS = 128;
constexpr unsigned POSES = 4;
constexpr unsigned SLOTS = THREADS * POSES;
/** \brief Correspondences of a block. */
constexpr unsigned PIECE = 64;

/** \brief Blocks that a multiprocessor's registers shall suffice for. Seven: the usual call's
 * 880 blocks are all resident on 132 multiprocessors, and none waits for a second round. The
 * sums of the other scores take more registers. */
constexpr unsigned
residentBlocks(ScoreMetric metric)
{
  return metric == ScoreMetric::Inliers ? 7 : 6;
}

/** \brief A correspondence as two reads of 16 bytes. */
struct SharedPair {
  float4 source, target;
};

template <ScoreMetric METRIC>
__global__ void
__launch_bounds__(THREADS, residentBlocks(METRIC)) scorePoses(const Call call)
{
  if (!planHolds(call))
    return;
  const unsigned first = blockIdx.x * SLOTS;
  const unsigned used = call.control->pivots * call.cliques_per_pivot;
  if (first >= used && first + SLOTS < call.slots)
    return; // nothing in these slots; the guess is in the last one
  auto* pairs = reinterpret_cast<SharedPair*>(sharedMemory());
  if (threadIdx.x < PIECE) {
    const unsigned i = blockIdx.y * PIECE + threadIdx.x;
    pairs[threadIdx.x] = {make_float4(call.sx[i], call.sy[i], call.sz[i], 0),
                          make_float4(call.tx[i], call.ty[i], call.tz[i], 0)};
  }
  SlotPose poses[POSES];
  long long sums[POSES];
#pragma unroll
  for (unsigned k = 0; k < POSES; ++k) {
    const unsigned slot = first + k * THREADS + threadIdx.x;
    poses[k] = slot < call.slots ? call.slot_poses[slot] : SlotPose{};
    sums[k] = 0;
  }
  __syncthreads();
  unsigned counts[POSES] = {};
  for (unsigned i = 0; i < PIECE; ++i) {
    const float4 s = pairs[i].source, t = pairs[i].target;
    const PointPair pair{s.x, s.y, s.z, t.x, t.y, t.z};
#pragma unroll
    for (unsigned k = 0; k < POSES; ++k)
      if (isInlier(poses[k].pose, poses[k].bounds, call.inlier_distance, pair)) {
        if (METRIC == ScoreMetric::Inliers)
          ++counts[k];
        else
          sums[k] += scoreOf<METRIC>(poses[k].pose, call.inlier_distance, pair);
      }
  }
#pragma unroll
  for (unsigned k = 0; k < POSES; ++k) {
    const long long sum =
        METRIC == ScoreMetric::Inliers ? counts[k] * SCORE_UNIT : sums[k];
    if (sum > 0)
      atomicAdd(reinterpret_cast<unsigned long long*>(call.scores + first +
                                                      k * THREADS + threadIdx.x),
                static_cast<unsigned long long>(sum));
  }
}

void (*kernelFor(ScoreMetric metric))(Call)
{
  switch (metric) {
  case ScoreMetric::Mae:
    return &scorePoses<ScoreMetric::Mae>;
  case ScoreMetric::Mse:
    return &scorePoses<ScoreMetric::Mse>;
  case ScoreMetric::Inliers:
    break;
  }
  return &scorePoses<ScoreMetric::Inliers>;
}

} // namespace

void
verification(const Call& call, cudaStream_t stream)
{
  const Shape shape{
      dim3((call.slots + SLOTS - 1) / SLOTS, (call.size + PIECE - 1) / PIECE),
      dim3(THREADS),
      PIECE * sizeof(SharedPair)};
  launch(kernelFor(call.metric), shape, stream, call);
}

} // namespace cuda
} // namespace pcl_flashreg
