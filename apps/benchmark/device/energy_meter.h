// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include <optional>
#include <string>

namespace pcl_flashreg::benchmark {

/** \brief The device's own energy counter, by NVML, which comes with the driver and is
 * loaded when it is asked for. */
class EnergyMeter {
public:
  /** \param[in] pci_bus_id of the device, as CUDA gives it */
  explicit EnergyMeter(const std::string& pci_bus_id);
  ~EnergyMeter();
  EnergyMeter(const EnergyMeter&) = delete;
  EnergyMeter&
  operator=(const EnergyMeter&) = delete;

  /** \brief Millijoules since the driver was loaded; nothing if there is no NVML or the
   * device does not count. */
  std::optional<double>
  read() const;

private:
  void* library_ = nullptr;
  void* device_ = nullptr;
};

} // namespace pcl_flashreg::benchmark
