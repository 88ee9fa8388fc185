// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "cuda/estimation/cuda_backend.h"

#include "cuda/estimation/caller_memory.h"
#include "cuda/estimation/first_order_graph.cuh"
#include "cuda/estimation/stages.h"
#include "cuda/support/device.h"

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

Stages
stagesOn(int device, const Options& options)
{
  return Stages(
      options,
      static_cast<unsigned>(attribute(cudaDevAttrMultiProcessorCount, device)),
      attribute(cudaDevAttrCooperativeLaunch, device) != 0);
}

class CudaBackend : public Backend {
public:
  /** \param[in] device the calling thread's */
  CudaBackend(int device, const Options& options)
      : options_(options), device_(device), stages_(stagesOn(device, options))
  {
  }

  std::string
  name() const override
  {
    return "cuda";
  }

  std::unique_ptr<Backend>
  another(ThreadPool&) const override
  {
    const CurrentDevice current(device_);
    return std::make_unique<CudaBackend>(device_, options_);
  }

  bool
  isOnDevice() const override
  {
    return true;
  }

  PoseEstimate
  run(const Problem& problem,
      const Parameters& parameters,
      const std::optional<Pose>& guess,
      bool with_candidates,
      StageClock& clock,
      Trace* trace) override
  {
    const CurrentDevice current(device_);
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

  CorrespondenceView<float>
  readBack(const DeviceCorrespondences& correspondences) override
  {
    const CurrentDevice current(device_);
    return callerMemory().read(correspondences);
  }

  void
  leavePose(const float T_target_source[16],
            const DeviceCorrespondences& asked) override
  {
    const CurrentDevice current(device_);
    callerMemory().leavePose(T_target_source, asked);
  }

private:
  /** \brief Made when it is wanted: few callers have their own. */
  CallerMemory&
  callerMemory()
  {
    if (!caller_memory_)
      caller_memory_.emplace();
    return *caller_memory_;
  }

  Options options_;
  int device_;
  Stages stages_;
  std::optional<CallerMemory> caller_memory_;
};

} // namespace

std::unique_ptr<Backend>
makeBackend(const Options& options)
{
  return std::make_unique<CudaBackend>(usableDevice(), options);
}

Stages
makeStages(const Options& options)
{
  return stagesOn(usableDevice(), options);
}

} // namespace cuda

std::unique_ptr<Backend>
makeCudaBackend()
{
  return cuda::makeBackend({});
}

} // namespace pcl_flashreg
