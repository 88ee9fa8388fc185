// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 5: one rigid transform a clique, in closed form, and the caller's guess behind
// them. Double precision throughout, a thread a slot; small blocks spread over all
// multiprocessors, since it is a chain of operations that takes the time.

#include "cuda/estimation/hypotheses.cuh"

#include "cuda/support/block.cuh"
#include "cuda/support/launch.cuh"
#include "math/triplet_alignment.h"

namespace pcl_flashreg {
namespace cuda {
namespace {

__device__ inline Vec3
source(const Call& call, unsigned i)
{
  return {call.sx[i], call.sy[i], call.sz[i]};
}
__device__ inline Vec3
target(const Call& call, unsigned i)
{
  return {call.tx[i], call.ty[i], call.tz[i]};
}

__device__ inline bool
holdsClique(const Call& call, unsigned slot)
{
  const unsigned p = slot / call.cliques_per_pivot;
  return slot + 1 < call.slots && p < call.control->pivots &&
         slot % call.cliques_per_pivot < call.clique_counts[p];
}

/** \return whether the slot holds a pose */
__device__ inline bool
poseOf(const Call& call, unsigned slot, Pose& pose)
{
  if (slot + 1 == call.slots) {
    pose = call.guess;
    return call.has_guess;
  }
  if (!holdsClique(call, slot))
    return false;
  const Clique c = call.cliques[slot];
  const Vec3 s[3] = {source(call, c.u), source(call, c.v), source(call, c.w)};
  const Vec3 t[3] = {target(call, c.u), target(call, c.v), target(call, c.w)};
  return alignTriplet(s, t, call.upright, pose);
}

__global__ void
__launch_bounds__(WARP) alignCliques(const Call call)
{
  if (!planHolds(call))
    return;
  const unsigned slot = blockIdx.x * WARP + threadIdx.x;
  if (slot >= call.slots)
    return;
  if (slot < LISTED_CLIQUES)
    call.listed_cliques[slot] = holdsClique(call, slot) ? call.cliques[slot] : Clique{};
  Pose pose;
  const bool valid = poseOf(call, slot, pose);
  call.scores[slot] = valid ? 0 : -1;
  if (!valid) {
    // Nothing is below these bounds.
    call.slot_poses[slot] = {};
    return;
  }
  call.poses[slot] = pose;
  SlotPose single{};
  single.pose = toSingle(pose);
  single.bounds = residualBounds(single.pose, call.radius, call.inlier_distance);
  call.slot_poses[slot] = single;
}

} // namespace

void
hypotheses(const Call& call, cudaStream_t stream)
{
  const Shape shape{dim3((call.slots + WARP - 1) / WARP), dim3(WARP), 0};
  launch(&alignCliques, shape, stream, call);
}

} // namespace cuda
} // namespace pcl_flashreg
