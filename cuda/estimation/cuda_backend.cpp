// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cuda/estimation/cuda_backend.h"

#include "cuda/estimation/first_order_graph.cuh"
#include "cuda/estimation/stages.h"

#include <pcl_flashreg/estimator.h>

#include <string>

namespace pcl_flashreg {
namespace cuda {
namespace {

/** \brief The oldest device that nvcc still compiles for, as major * 10 + minor. */
constexpr int LEAST_CAPABILITY = 75;

int
attribute(cudaDeviceAttr which, int device)
{
  int value = 0;
  PCL_FLASHREG_CUDA(cudaDeviceGetAttribute(&value, which, device));
  return value;
}

/** \throws BackendError, with the reason, if there is no device that can be used
 * \return the device */
int
usableDevice()
{
  int count = 0;
  const cudaError_t error = cudaGetDeviceCount(&count);
  if (error != cudaSuccess || count == 0) {
    cudaGetLastError();
    throw BackendError(
        std::string("backend cuda: no usable device: ") +
        cudaGetErrorString(error == cudaSuccess ? cudaErrorNoDevice : error));
  }
  int device = 0;
  PCL_FLASHREG_CUDA(cudaGetDevice(&device));
  const int major = attribute(cudaDevAttrComputeCapabilityMajor, device);
  const int minor = attribute(cudaDevAttrComputeCapabilityMinor, device);
  if (10 * major + minor < LEAST_CAPABILITY)
    throw BackendError("backend cuda: the device has compute capability " +
                       std::to_string(major) + "." + std::to_string(minor) +
                       "; it takes 7.5 or later");
  requireKernelImage();
  return device;
}

class CudaBackend : public Backend {
public:
  explicit CudaBackend(const Options& options) : stages_(makeStages(options)) {}

  std::string
  name() const override
  {
    return "cuda";
  }

  PoseEstimate
  run(const Problem& problem,
      const Parameters& parameters,
      const std::optional<Pose>& guess,
      bool with_candidates,
      StageClock& clock,
      Trace* trace) override
  {
    try {
      return runPipeline(
          stages_, problem, parameters, guess, with_candidates, clock, trace);
    }
    catch (...) {
      // Nothing of this call may be under way when the next one begins.
      stages_.abandon();
      throw;
    }
  }

private:
  Stages stages_;
};

} // namespace

std::unique_ptr<Backend>
makeBackend(const Options& options)
{
  return std::make_unique<CudaBackend>(options);
}

Stages
makeStages(const Options& options)
{
  const int device = usableDevice();
  return Stages(
      options,
      static_cast<unsigned>(attribute(cudaDevAttrMultiProcessorCount, device)),
      attribute(cudaDevAttrCooperativeLaunch, device) != 0);
}

} // namespace cuda

std::unique_ptr<Backend>
makeCudaBackend()
{
  return cuda::makeBackend({});
}

} // namespace pcl_flashreg
