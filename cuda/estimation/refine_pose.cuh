// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

// Reweighted alignment of one pose, by one block.

#include "cuda/support/block.cuh"
#include "cuda/estimation/call.cuh"
#include "math/weighted_alignment.h"
#include "cuda/estimation/residual_test.cuh"

namespace pcl_flashreg {
namespace cuda {

/** \brief The 16 sums of an alignment are those of (1, s) times (1, t): a warp each. */
constexpr unsigned ALIGNMENT_SUMS = 16;
constexpr unsigned REFINE_WARPS = ALIGNMENT_SUMS;
constexpr unsigned REFINE_THREADS = REFINE_WARPS * WARP;
/** \brief Words of inliers that a warp works on at a time. */
constexpr unsigned AHEAD = 4;
static_assert(ALIGNMENT_LANES == WARP, "a lane of the warp is a lane of the sums");

struct RefineShared {
  BlockScratch scratch;
  Pose pose;
  SlotPose single;
  bool aligned;
  double sums[ALIGNMENT_SUMS];
  /** \brief A piece of the inliers: their weights and coordinates. */
  double weights[REFINE_THREADS];
  float coordinates[6][REFINE_THREADS];
  unsigned long long score;

  /** \brief Inliers, one bit each; behind this struct. */
  __device__ unsigned*
  inliers()
  {
    return reinterpret_cast<unsigned*>(this + 1);
  }
};

__device__ inline PointPair
pairOf(const Call& call, unsigned i)
{
  return {call.sx[i], call.sy[i], call.sz[i], call.tx[i], call.ty[i], call.tz[i]};
}

/** \brief Fills every REFINE_WARPS-th word of the inliers from the first on, AHEAD of them, a
 * warp's share of a step. All coordinates are on their way before the first is waited for:
 * nothing else hides how long that takes. */
__device__ inline void
findWords(const Call& call, const SlotPose& pose, unsigned first, unsigned* inliers)
{
  PointPair pairs[AHEAD];
#pragma unroll
  for (unsigned k = 0; k < AHEAD; ++k) {
    const unsigned w = min(first + k * REFINE_WARPS, call.words - 1);
    pairs[k] = pairOf(call, w * WARP + laneIndex());
  }
#pragma unroll
  for (unsigned k = 0; k < AHEAD; ++k) {
    const bool inlier =
        isInlier(pose.pose, pose.bounds, call.inlier_distance, pairs[k]);
    const unsigned word = __ballot_sync(ALL_LANES, inlier);
    const unsigned w = first + k * REFINE_WARPS;
    if (laneIndex() == 0 && w < call.words)
      inliers[w] = word;
  }
}

/** \brief Finds the inliers of the pose at hand and lists them, ascending.
 * \return their number */
__device__ inline unsigned
findInliers(const Call& call, unsigned* list, RefineShared& shared)
{
  if (threadIdx.x == 0) {
    shared.single.pose = toSingle(shared.pose);
    shared.single.bounds =
        residualBounds(shared.single.pose, call.radius, call.inlier_distance);
  }
  __syncthreads();
  for (unsigned first = warpIndex(); first < call.words; first += AHEAD * REFINE_WARPS)
    findWords(call, shared.single, first, shared.inliers());
  __syncthreads();

  const unsigned* inliers = shared.inliers();
  const unsigned run = (call.words + REFINE_THREADS - 1) / REFINE_THREADS;
  const unsigned begin = min(call.words, threadIdx.x * run);
  const unsigned end = min(call.words, begin + run);
  unsigned count = 0;
  for (unsigned w = begin; w < end; ++w)
    count += __popc(inliers[w]);
  unsigned total = 0;
  unsigned at = blockExclusiveScan(count, shared.scratch, total);
  for (unsigned w = begin; w < end; ++w)
    for (unsigned bits = inliers[w]; bits != 0; bits &= bits - 1)
      list[at++] = w * WARP + __ffs(static_cast<int>(bits)) - 1;
  __syncthreads();
  return total;
}

/** \brief Reads one piece of the inliers and weights them by 1 / (1 + (d / limit)^2). */
__device__ inline void
weighPiece(const Call& call, unsigned i, RefineShared& shared)
{
  const PointPair c = pairOf(call, i);
  const Vec3 s{c.sx, c.sy, c.sz}, t{c.tx, c.ty, c.tz};
  const double inverse_limit = 1.0 / call.inlier_distance;
  const Vec3 d = inverse_limit * (transform(shared.pose, s) - t);
  shared.weights[threadIdx.x] = 1.0 / (1.0 + dot(d, d));
  shared.coordinates[0][threadIdx.x] = c.sx;
  shared.coordinates[1][threadIdx.x] = c.sy;
  shared.coordinates[2][threadIdx.x] = c.sz;
  shared.coordinates[3][threadIdx.x] = c.tx;
  shared.coordinates[4][threadIdx.x] = c.ty;
  shared.coordinates[5][threadIdx.x] = c.tz;
}

/** \brief Sums up all inliers, rounding like AlignmentSums::add() and sumLanes(): inlier
 * k goes to lane k % 32, and products by 1 are exact. */
__device__ inline void
sumInliers(const Call& call, const unsigned* list, unsigned count, RefineShared& shared)
{
  const unsigned a = warpIndex() / 4, b = warpIndex() % 4;
  double sum = 0;
  for (unsigned first = 0; first < count; first += REFINE_THREADS) {
    const unsigned piece = min(REFINE_THREADS, count - first);
    if (threadIdx.x < piece)
      weighPiece(call, list[first + threadIdx.x], shared);
    __syncthreads();
    for (unsigned k = laneIndex(); k < piece; k += WARP) {
      const double s = a == 0 ? 1.0 : shared.coordinates[a - 1][k];
      const double t = b == 0 ? 1.0 : shared.coordinates[2 + b][k];
      sum += shared.weights[k] * s * t;
    }
    __syncthreads();
  }
  for (unsigned distance = WARP / 2; distance > 0; distance /= 2)
    sum += __shfl_down_sync(ALL_LANES, sum, distance);
  if (laneIndex() == 0)
    shared.sums[warpIndex()] = sum;
  __syncthreads();
}

/** \brief Aligns by the sums; the first thread. */
__device__ inline bool
align(const double sums[ALIGNMENT_SUMS], const Upright& upright, Pose& pose)
{
  AlignmentSums all;
  all.weight = sums[0];
  all.target = {sums[1], sums[2], sums[3]};
  all.source = {sums[4], sums[8], sums[12]};
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      all.products[3 * a + b] = sums[4 * (a + 1) + b + 1];
  return alignWeighted(all, upright, pose);
}

/** \brief Score of the pose at hand by its listed inliers. */
template <ScoreMetric METRIC>
__device__ inline void
addScores(const Call& call, const unsigned* list, unsigned count, RefineShared& shared)
{
  long long sum = 0;
  for (unsigned k = threadIdx.x; k < count; k += REFINE_THREADS)
    sum += scoreOf<METRIC>(
        shared.single.pose, call.inlier_distance, pairOf(call, list[k]));
  if (sum > 0)
    atomicAdd(&shared.score, static_cast<unsigned long long>(sum));
}

__device__ inline long long
scoreInliers(const Call& call,
             const unsigned* list,
             unsigned count,
             RefineShared& shared)
{
  if (call.metric == ScoreMetric::Inliers)
    return count * SCORE_UNIT;
  if (threadIdx.x == 0)
    shared.score = 0;
  __syncthreads();
  if (call.metric == ScoreMetric::Mae)
    addScores<ScoreMetric::Mae>(call, list, count, shared);
  else
    addScores<ScoreMetric::Mse>(call, list, count, shared);
  __syncthreads();
  return static_cast<long long>(shared.score);
}

/** \brief Up to refinement_iterations rounds of alignment over the current inliers, until
 * their number no longer changes. Leaves the inliers in shared memory.
 * \param[out] list room for the indices of all correspondences */
__device__ inline void
refinePose(const Call& call,
           const Pose& start,
           unsigned* list,
           RefineShared& shared,
           ScoredPose& refined)
{
  if (threadIdx.x == 0)
    shared.pose = start;
  unsigned count = findInliers(call, list, shared);
  for (unsigned round = 0; round < call.refinement_iterations; ++round) {
    sumInliers(call, list, count, shared);
    if (threadIdx.x == 0) {
      Pose next;
      shared.aligned = align(shared.sums, call.upright, next);
      if (shared.aligned)
        shared.pose = next;
    }
    __syncthreads();
    if (!shared.aligned)
      break;
    const unsigned previous = count;
    count = findInliers(call, list, shared);
    if (count == previous)
      break;
  }
  const long long score = scoreInliers(call, list, count, shared);
  if (threadIdx.x == 0) {
    refined.pose = shared.pose;
    refined.score = score;
    refined.inlier_count = static_cast<int>(count);
  }
}

} // namespace cuda
} // namespace pcl_flashreg
