// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

// Correspondences that a network left in the memory of a GPU: to a pose, which stays there.

#include <pcl_flashreg/estimator.h>

#include <cuda_runtime.h>

#include <cmath>
#include <cstdio>
#include <vector>

int
main()
{
  // Every third of 300 matches is right: the target is the source, shifted by (1, 2, 3).
  constexpr std::size_t N = 300;
  std::vector<float> source(3 * N), target(3 * N);
  for (std::size_t i = 0; i < 3 * N; ++i) {
    source[i] = 4 * std::abs(std::sin(12.9898f * static_cast<float>(i + 1)));
    target[i] = i / 3 % 3 == 0
                    ? source[i] + static_cast<float>(i % 3 + 1)
                    : 4 * std::abs(std::sin(78.233f * static_cast<float>(i)));
  }
  cudaStream_t stream;
  cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking);
  const std::size_t bytes = 3 * N * sizeof(float);
  void* on_device[3] = {};
  for (void*& memory : on_device)
    cudaMalloc(&memory, bytes);
  cudaMemcpyAsync(on_device[0], source.data(), bytes, cudaMemcpyHostToDevice, stream);
  cudaMemcpyAsync(on_device[1], target.data(), bytes, cudaMemcpyHostToDevice, stream);

  pcl_flashreg::DeviceCorrespondences correspondences;
  correspondences.source_xyz = static_cast<const float*>(on_device[0]);
  correspondences.target_xyz = static_cast<const float*>(on_device[1]);
  correspondences.size = N;
  correspondences.stream = stream;
  correspondences.T_target_source = static_cast<float*>(on_device[2]);
  pcl_flashreg::Estimator estimator(pcl_flashreg::BackendKind::Cuda);
  const pcl_flashreg::Result result = estimator.estimate(
      correspondences, pcl_flashreg::Parameters::fromResolution(0.05));
  // What comes after in the stream finds the pose: here, a copy to the host.
  float T[16];
  cudaMemcpyAsync(T, on_device[2], sizeof T, cudaMemcpyDeviceToHost, stream);
  cudaStreamSynchronize(stream);
  std::printf("%s: %zu of %zu agree, shifted by (%.2f, %.2f, %.2f), %s\n",
              result.backend.c_str(),
              result.inliers.size(),
              N,
              T[3],
              T[7],
              T[11],
              result.converged ? "trusted" : "not trusted");
  for (void* memory : on_device)
    cudaFree(memory);
  cudaStreamDestroy(stream);
  return result.converged ? 0 : 1;
}
