// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "dense_refinement.cuh"

#include "dense_score.cuh"
#include "cuda/support/launch.cuh"
#include "cuda/estimation/refine_pose.cuh"
#include "cuda/estimation/slot_rank.cuh"

#include <cmath>

namespace pcl_flashreg {
namespace dense {
namespace {

using namespace cuda;

constexpr unsigned THREADS = 256;
constexpr unsigned WARPS = THREADS / WARP;
static_assert(sizeof(PartialSums::sums) == ALIGNMENT_SUMS * sizeof(double),
              "the sums of an alignment");

/** \brief Copies the best hypothesis, the first of equals; one block. */
__global__ void
__launch_bounds__(REFINE_THREADS) pickBest(const Call call, Pose* best)
{
  unsigned long long rank = 0;
  for (unsigned slot = threadIdx.x; slot < call.slots; slot += REFINE_THREADS) {
    const long long score = call.scores[slot];
    if (score >= 0 && rankOf(score, slot) > rank)
      rank = rankOf(score, slot);
  }
  rank = blockMax(rank, *reinterpret_cast<BlockScratch*>(sharedMemory()));
  if (threadIdx.x != 0)
    return;
  if (rank > 0)
    *best = call.poses[slotOf(rank)];
  else
    best->t[0] = NAN; // nothing is an inlier of that
}

/** \brief Residuals, inliers, weights and their sums, block by block. */
__global__ void
__launch_bounds__(THREADS)
    addPartialSums(const Call call, const Pose* current, PartialSums* partial_sums)
{
  const Pose pose = *current;
  const unsigned i = blockIdx.x * THREADS + threadIdx.x;
  const float limit = call.inlier_distance;
  PointPair c{};
  bool inlier = false;
  if (i < call.size) {
    c = pairOf(call, i);
    inlier = squaredResidual(toSingle(pose), c) < limit * limit;
  }
  double weight = 0;
  if (inlier) {
    const Vec3 s{c.sx, c.sy, c.sz}, t{c.tx, c.ty, c.tz};
    const Vec3 d = (1.0 / limit) * (transform(pose, s) - t);
    weight = 1.0 / (1.0 + dot(d, d));
  }
  auto* shared = reinterpret_cast<PartialSums*>(sharedMemory());
  const double s[4] = {1, c.sx, c.sy, c.sz}, t[4] = {1, c.tx, c.ty, c.tz};
#pragma unroll
  for (unsigned k = 0; k < ALIGNMENT_SUMS; ++k) {
    double sum = weight * s[k / 4] * t[k % 4];
    for (unsigned distance = WARP / 2; distance > 0; distance /= 2)
      sum += __shfl_down_sync(ALL_LANES, sum, distance);
    if (laneIndex() == 0)
      shared[warpIndex()].sums[k] = sum;
  }
  const unsigned inliers = __popc(__ballot_sync(ALL_LANES, inlier));
  if (laneIndex() == 0)
    shared[warpIndex()].inliers = inliers;
  __syncthreads();
  PartialSums& mine = partial_sums[blockIdx.x];
  if (threadIdx.x < ALIGNMENT_SUMS) {
    double sum = 0;
    for (unsigned w = 0; w < WARPS; ++w)
      sum += shared[w].sums[threadIdx.x];
    mine.sums[threadIdx.x] = sum;
  }
  if (threadIdx.x == 0) {
    mine.inliers = 0;
    for (unsigned w = 0; w < WARPS; ++w)
      mine.inliers += shared[w].inliers;
  }
}

/** \brief Adds up the blocks and aligns; one warp. */
__global__ void
__launch_bounds__(WARP) alignByPartialSums(const PartialSums* partial_sums,
                                           unsigned blocks,
                                           Pose* next,
                                           Round* round)
{
  auto& total = *reinterpret_cast<PartialSums*>(sharedMemory());
  if (threadIdx.x < ALIGNMENT_SUMS) {
    double sum = 0;
    for (unsigned b = 0; b < blocks; ++b)
      sum += partial_sums[b].sums[threadIdx.x];
    total.sums[threadIdx.x] = sum;
  }
  unsigned inliers = 0;
  for (unsigned b = threadIdx.x; b < blocks; b += WARP)
    inliers += partial_sums[b].inliers;
  inliers = warpSum(inliers);
  __syncthreads();
  if (threadIdx.x == 0)
    *round = {inliers, align(total.sums, {}, *next)};
}

struct ListShared {
  unsigned inliers;
  unsigned long long score;
};

/** \brief Lists the pose with its inliers and its score; one block. */
__global__ void
__launch_bounds__(REFINE_THREADS) listPose(const Call call, const Pose* refined)
{
  auto& shared = *reinterpret_cast<ListShared*>(sharedMemory());
  if (threadIdx.x == 0)
    shared = {0, 0};
  __syncthreads();
  const PoseF pose = toSingle(*refined);
  for (unsigned w = warpIndex(); w < call.words; w += REFINE_THREADS / WARP) {
    const long long score =
        scoreOf(call.metric,
                squaredResidual(pose, pairOf(call, w * WARP + laneIndex())),
                call.inlier_distance);
    const unsigned word = __ballot_sync(ALL_LANES, score > 0);
    if (score > 0)
      atomicAdd(&shared.score, static_cast<unsigned long long>(score));
    if (laneIndex() != 0)
      continue;
    call.listed_inliers[w] = word;
    atomicAdd(&shared.inliers, static_cast<unsigned>(__popc(word)));
  }
  __syncthreads();
  if (threadIdx.x != 0)
    return;
  call.listed[0] = {
      *refined, static_cast<long long>(shared.score), static_cast<int>(shared.inliers)};
  call.control->listed_count = 1;
}

} // namespace

/** \brief Counts the inliers of a pose and leaves the one that they give behind it. */
Round
Refinement::measure(const Call& call, Pose* pose, const Stream& stream)
{
  const unsigned blocks = (call.size + THREADS - 1) / THREADS;
  partial_sums_.reserve(blocks);
  launch(&addPartialSums,
         {dim3(blocks), dim3(THREADS), WARPS * sizeof(PartialSums)},
         stream.get(),
         call,
         static_cast<const Pose*>(pose),
         partial_sums_.data());
  launch(&alignByPartialSums,
         {dim3(1), dim3(WARP), sizeof(PartialSums)},
         stream.get(),
         static_cast<const PartialSums*>(partial_sums_.data()),
         blocks,
         pose + 1,
         round_.data());
  PCL_FLASHREG_CUDA(cudaMemcpyAsync(host_round_.data(),
                                    round_.data(),
                                    sizeof(Round),
                                    cudaMemcpyDeviceToHost,
                                    stream.get()));
  stream.synchronize();
  return *host_round_.data();
}

void
Refinement::run(const Call& call, const Stream& stream)
{
  poses_.reserve(call.refinement_iterations + std::size_t{2});
  round_.reserve(1);
  host_round_.reserve(1);
  launch(&pickBest,
         {dim3(1), dim3(REFINE_THREADS), sizeof(BlockScratch)},
         stream.get(),
         call,
         poses_.data());
  Pose* pose = poses_.data();
  unsigned previous = 0;
  for (unsigned done = 0;; ++done, ++pose) {
    const Round round = measure(call, pose, stream);
    if (round.inliers == previous || !round.aligned ||
        done == call.refinement_iterations)
      break;
    previous = round.inliers;
  }
  launch(&listPose,
         {dim3(1), dim3(REFINE_THREADS), sizeof(ListShared)},
         stream.get(),
         call,
         static_cast<const Pose*>(pose));
}

} // namespace dense
} // namespace pcl_flashreg
