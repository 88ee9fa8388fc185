// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Stage 6 with every residual of every hypothesis in memory: a kernel writes them, another
// adds them up, a block a slot in both. Residuals stay squared, which spares their roots.

#include "dense_verification.cuh"

#include "cuda/support/block.cuh"
#include "dense_score.cuh"
#include "cuda/support/launch.cuh"

namespace pcl_flashreg {
namespace dense {
namespace {

using namespace cuda;

constexpr unsigned THREADS = 256;

__global__ void
__launch_bounds__(THREADS)
    writeResiduals(const Call call, const Matrix<float> residuals)
{
  const unsigned slot = blockIdx.x;
  if (call.scores[slot] < 0)
    return; // no pose
  const PoseF pose = call.slot_poses[slot].pose;
  for (unsigned i = threadIdx.x; i < call.size; i += THREADS)
    residuals.row(slot)[i] = squaredResidual(
        pose, {call.sx[i], call.sy[i], call.sz[i], call.tx[i], call.ty[i], call.tz[i]});
}

__global__ void
__launch_bounds__(THREADS) addScores(const Call call, const Matrix<float> residuals)
{
  const unsigned slot = blockIdx.x;
  if (call.scores[slot] < 0)
    return;
  auto& sum = *reinterpret_cast<unsigned long long*>(sharedMemory());
  if (threadIdx.x == 0)
    sum = 0;
  __syncthreads();
  long long mine = 0;
  for (unsigned i = threadIdx.x; i < call.size; i += THREADS)
    mine += scoreOf(call.metric, residuals.row(slot)[i], call.inlier_distance);
  if (mine > 0)
    atomicAdd(&sum, static_cast<unsigned long long>(mine));
  __syncthreads();
  if (threadIdx.x == 0)
    call.scores[slot] = static_cast<long long>(sum);
}

} // namespace

void
verification(const Call& call, Matrix<float> residuals, cudaStream_t stream)
{
  Shape shape{dim3(call.slots), dim3(THREADS), 0};
  launch(&writeResiduals, shape, stream, call, residuals);
  shape.shared_bytes = sizeof(unsigned long long);
  launch(&addScores, shape, stream, call, residuals);
}

} // namespace dense
} // namespace pcl_flashreg
