// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 7: the best hypotheses that differ from one another are refined on their inliers.
//
// Which hypothesis is refined next depends on what the ones before it became. But as long
// as none of them enters the list, the next ones are known: a batch of them is refined side
// by side, a block each, and then gone through in order; those that a pose which entered
// the list explains are dropped, as if they had never been refined. The outcome is that of
// one after the other. On KITTI 000, ten refinements of up to twelve rounds take two
// batches.

#include "cuda/estimation/refinement.cuh"

#include "cuda/support/launch.cuh"
#include "math/distinctness.h"
#include "cuda/estimation/refine_pose.cuh"
#include "cuda/estimation/slot_rank.cuh"

#include <cooperative_groups.h>

#include <algorithm>

namespace pcl_flashreg {
namespace cuda {
namespace {

/** \brief Whether two of the three correspondences behind a hypothesis agree with one that
 * is listed already. */
__device__ inline bool
explained(const Call& call, unsigned slot, unsigned listed)
{
  if (slot + 1 == call.slots)
    return false; // the caller's guess
  const Clique c = call.cliques[slot];
  for (unsigned h = 0; h < listed; ++h) {
    const unsigned* inliers = call.listed_inliers + std::size_t{h} * call.words;
    const unsigned agree = ((inliers[c.u / WARP] >> (c.u % WARP)) & 1) +
                           ((inliers[c.v / WARP] >> (c.v % WARP)) & 1) +
                           ((inliers[c.w / WARP] >> (c.w % WARP)) & 1);
    if (agree >= 2)
      return true;
  }
  return false;
}

/** \brief Scores that a thread reads at a time; the usual call has eight a thread. */
constexpr unsigned SCORES_AHEAD = 8;

/** \brief The best of this thread's slots that ranks below `limit` and that no listed pose
 * explains; 0 if there is none. */
__device__ inline unsigned long long
bestBelow(const Call& call, unsigned long long limit, unsigned listed)
{
  unsigned long long best = 0;
  for (unsigned first = threadIdx.x; first < call.slots;
       first += SCORES_AHEAD * REFINE_THREADS) {
    // All of them on their way before the first is waited for.
    long long scores[SCORES_AHEAD];
#pragma unroll
    for (unsigned k = 0; k < SCORES_AHEAD; ++k) {
      const unsigned slot = first + k * REFINE_THREADS;
      scores[k] = slot < call.slots ? call.scores[slot] : -1;
    }
#pragma unroll
    for (unsigned k = 0; k < SCORES_AHEAD; ++k) {
      const unsigned slot = first + k * REFINE_THREADS;
      const unsigned long long rank = scores[k] < 0 ? 0 : rankOf(scores[k], slot);
      if (rank < limit && rank > best && !explained(call, slot, listed))
        best = rank;
    }
  }
  return best;
}

/** \brief Chooses the next hypotheses to be refined, up to `wanted`; one block.
 * \return how many there are */
__device__ inline unsigned
selectBatch(const Call& call,
            unsigned long long limit,
            unsigned listed,
            unsigned wanted,
            BlockScratch& scratch)
{
  Control& control = *call.control;
  unsigned long long best = bestBelow(call, limit, listed);
  unsigned n = 0;
  for (; n < wanted; ++n) {
    const unsigned long long rank = blockMax(best, scratch);
    if (rank == 0)
      break;
    if (threadIdx.x == 0)
      control.batch[n] = slotOf(rank);
    if (best == rank)
      best = bestBelow(call, rank, listed);
  }
  if (threadIdx.x == 0)
    control.batch_size = n;
  __syncthreads();
  return n;
}

/** \brief Whether a pose is the same as one that is listed; one block. */
__device__ inline bool
isListed(const Call& call, const Pose& pose, unsigned listed)
{
  // Eight threads a listed pose, one a corner.
  const unsigned h = threadIdx.x / CORNERS;
  const bool agree = h < listed && agreeOnCorner(call.listed[h].pose,
                                                 pose,
                                                 call.radius,
                                                 call.inlier_distance,
                                                 threadIdx.x % CORNERS);
  const unsigned agreeing = __ballot_sync(ALL_LANES, agree);
  const unsigned corners = (agreeing >> (laneIndex() / CORNERS * CORNERS)) & 0xFF;
  return __syncthreads_or(corners == 0xFF) != 0;
}

/** \brief Goes through the refined batch in order and chooses the next; one block. */
__device__ inline void
acceptBatch(const Call& call, BlockScratch& scratch)
{
  Control& control = *call.control;
  const unsigned budget = REFINEMENTS_A_HYPOTHESIS * call.max_hypotheses;
  const unsigned listed_before = control.listed_count;
  const unsigned size = control.batch_size;
  unsigned listed = listed_before, refinements = control.refinements;
  unsigned long long last_rank = control.last_rank;
  for (unsigned c = 0; c < size && listed < call.max_hypotheses && refinements < budget;
       ++c) {
    const unsigned slot = control.batch[c];
    last_rank = rankOf(call.scores[slot], slot);
    if (listed > listed_before && explained(call, slot, listed))
      continue;
    ++refinements;
    const ScoredPose& refined = control.candidates[c];
    if (isListed(call, refined.pose, listed))
      continue;
    const unsigned* from = call.candidate_inliers + std::size_t{c} * call.words;
    unsigned* to = call.listed_inliers + std::size_t{listed} * call.words;
    for (unsigned w = threadIdx.x; w < call.words; w += REFINE_THREADS)
      to[w] = from[w];
    if (threadIdx.x == 0)
      call.listed[listed] = refined;
    ++listed;
    __syncthreads();
  }
  const bool more = size > 0 && listed < call.max_hypotheses && refinements < budget;
  const unsigned wanted = more ? min(MOST_CANDIDATES, budget - refinements) : 0;
  const unsigned next = selectBatch(call, last_rank, listed, wanted, scratch);
  if (threadIdx.x == 0) {
    control.listed_count = listed;
    control.refinements = refinements;
    control.last_rank = last_rank;
    control.refinement_ticket = 0;
    // Only here, where all other blocks are through: no block may see it change.
    control.done = next == 0;
  }
}

/** \brief Refines a batch, and leaves the next; the first batch is the best hypothesis
 * alone, which nearly always explains most of the others. */
__device__ inline void
refineBatch(const Call& call, RefineShared& shared)
{
  Control& control = *call.control;
  if (blockIdx.x == 0 && control.last_rank == 0)
    selectBatch(call, ~0ull, 0, 1, shared.scratch);
  for (unsigned c = blockIdx.x; c < control.batch_size; c += gridDim.x) {
    unsigned* list = call.candidate_lists + std::size_t{c} * call.padded;
    refinePose(call, call.poses[control.batch[c]], list, shared, control.candidates[c]);
    unsigned* inliers = call.candidate_inliers + std::size_t{c} * call.words;
    for (unsigned w = threadIdx.x; w < call.words; w += REFINE_THREADS)
      inliers[w] = shared.inliers()[w];
  }
  if (lastBlock(&control.refinement_ticket))
    acceptBatch(call, shared.scratch);
}

__global__ void
__launch_bounds__(REFINE_THREADS) refineOnce(const Call call)
{
  if (planHolds(call) && !call.control->done)
    refineBatch(call, *reinterpret_cast<RefineShared*>(sharedMemory()));
}

__global__ void
__launch_bounds__(REFINE_THREADS) refineToTheEnd(const Call call)
{
  if (!planHolds(call))
    return;
  do {
    refineBatch(call, *reinterpret_cast<RefineShared*>(sharedMemory()));
    cooperative_groups::this_grid().sync();
  } while (!call.control->done);
}

} // namespace

void
refinement(const Call& call,
           bool cooperative,
           unsigned multiprocessors,
           cudaStream_t stream)
{
  const unsigned budget = REFINEMENTS_A_HYPOTHESIS * call.max_hypotheses;
  Shape shape{dim3(std::min(budget, MOST_CANDIDATES)),
              dim3(REFINE_THREADS),
              sizeof(RefineShared) + call.words * sizeof(unsigned)};
  if (cooperative) {
    shape.grid.x =
        std::min(shape.grid.x, residentBlocks(&refineToTheEnd, shape, multiprocessors));
    launchCooperative(&refineToTheEnd, shape, stream, call);
    return;
  }
  // A batch after the first one adds to the list, or is as large as it can be.
  const unsigned batches =
      1 + call.max_hypotheses + (budget + MOST_CANDIDATES - 1) / MOST_CANDIDATES;
  for (unsigned i = 0; i < batches; ++i)
    launch(&refineOnce, shape, stream, call);
}

} // namespace cuda
} // namespace pcl_flashreg
