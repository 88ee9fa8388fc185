// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "device_figures.h"

#include "cuda/estimation/cuda_backend.h"
#include "energy_meter.h"
#include "cuda/support/error.h"
#include "estimation/preparation.h"
#include "estimation/trace.h"

#include <pcl_flashreg/impl/stopwatch.hpp>

#include <algorithm>
#include <memory>

namespace pcl_flashreg::benchmark {
namespace {

using detail::Stopwatch;

std::size_t
freeBytes()
{
  std::size_t free = 0, total = 0;
  PCL_FLASHREG_CUDA(cudaMemGetInfo(&free, &total));
  return free;
}

int
currentDevice()
{
  int device = 0;
  PCL_FLASHREG_CUDA(cudaGetDevice(&device));
  return device;
}

/** \brief Beyond it, going through all pairs on the host takes longer than measuring. */
constexpr std::size_t LARGEST_COUNTED = 20000;

/** \brief Runs the pipeline on a problem whose points are on the device. */
class ResidentCall {
public:
  ResidentCall(const CorrespondenceView<double>& correspondences,
               const Parameters& parameters)
      : parameters_(parameters)
  {
    prepare(correspondences, parameters, problem_);
    cuda::Options options;
    options.resident_points = true;
    options.stage_timings = false;
    backend_ = cuda::makeBackend(options);
  }

  PoseEstimate
  operator()(Trace* trace = nullptr)
  {
    StageTimings timings;
    StageClock clock(timings);
    return backend_->run(problem_, parameters_, std::nullopt, false, clock, trace);
  }

  std::optional<Work>
  work()
  {
    if (problem_.size > LARGEST_COUNTED)
      return std::nullopt;
    Trace trace;
    const PoseEstimate estimate = (*this)(&trace);
    return workOf(problem_, trace, estimate.second_order == SecondOrder::Exact);
  }

private:
  Parameters parameters_;
  Problem problem_;
  std::unique_ptr<Backend> backend_;
};

Spread
timeCalls(ResidentCall& call, const Repetition& repetition)
{
  std::vector<double> times;
  const Stopwatch all;
  for (int i = 0; !repetition.isOver(i, all); ++i) {
    const Stopwatch stopwatch;
    call();
    times.push_back(stopwatch.milliseconds());
  }
  return spreadOf(times);
}

/** \brief Millijoules a call. */
std::optional<double>
energyOf(ResidentCall& call, double seconds)
{
  char bus_id[32] = {};
  PCL_FLASHREG_CUDA(cudaDeviceGetPCIBusId(bus_id, sizeof bus_id, currentDevice()));
  const EnergyMeter meter(bus_id);
  const std::optional<double> before = meter.read();
  if (!before)
    return std::nullopt;
  const Stopwatch stopwatch;
  std::size_t calls = 0;
  for (; stopwatch.milliseconds() < 1e3 * seconds; ++calls)
    call();
  const std::optional<double> after = meter.read();
  if (!after || calls == 0)
    return std::nullopt;
  return (*after - *before) / static_cast<double>(calls);
}

} // namespace

DeviceFigures
measureOnDevice(const CorrespondenceView<double>& correspondences,
                const Parameters& parameters,
                const DeviceEffort& effort)
{
  DeviceFigures figures;
  {
    const std::size_t free = freeBytes();
    ResidentCall call(correspondences, parameters);
    for (int i = 0; i < WARM_UP_RUNS; ++i)
      call();
    figures.resident_ms = timeCalls(call, effort.repetition);
    figures.memory_bytes = free - std::min(free, freeBytes());
    if (effort.energy_seconds > 0)
      figures.energy_mj = energyOf(call, effort.energy_seconds);
    figures.work = call.work();
  }
  return figures;
}

std::string
deviceName()
{
  cudaDeviceProp properties;
  PCL_FLASHREG_CUDA(cudaGetDeviceProperties(&properties, currentDevice()));
  return properties.name;
}

} // namespace pcl_flashreg::benchmark
