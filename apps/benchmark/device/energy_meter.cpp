// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#include "energy_meter.h"

#include <dlfcn.h>

namespace pcl_flashreg::benchmark {
namespace {

// NVML's interface as far as it is needed; its header is not part of every installation of
// CUDA. All of these return 0 on success.
using Init = int (*)();
using HandleByBusId = int (*)(const char*, void**);
using TotalEnergy = int (*)(void*, unsigned long long*);

template <typename Function>
Function
find(void* library, const char* name)
{
  return reinterpret_cast<Function>(dlsym(library, name));
}

} // namespace

EnergyMeter::EnergyMeter(const std::string& pci_bus_id)
    : library_(dlopen("libnvidia-ml.so.1", RTLD_NOW | RTLD_LOCAL))
{
  if (!library_)
    return;
  const auto init = find<Init>(library_, "nvmlInit_v2");
  const auto handle = find<HandleByBusId>(library_, "nvmlDeviceGetHandleByPciBusId_v2");
  if (init && handle && init() == 0 && handle(pci_bus_id.c_str(), &device_) != 0)
    device_ = nullptr;
}

EnergyMeter::~EnergyMeter()
{
  if (!library_)
    return;
  if (const auto shutdown = find<Init>(library_, "nvmlShutdown"))
    shutdown();
  dlclose(library_);
}

std::optional<double>
EnergyMeter::read() const
{
  if (!device_)
    return std::nullopt;
  const auto energy =
      find<TotalEnergy>(library_, "nvmlDeviceGetTotalEnergyConsumption");
  unsigned long long millijoules = 0;
  if (!energy || energy(device_, &millijoules) != 0)
    return std::nullopt;
  return static_cast<double>(millijoules);
}

} // namespace pcl_flashreg::benchmark
