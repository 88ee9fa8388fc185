// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) the pcl_flashreg authors

#pragma once

#include "../repetition.h"
#include "../spread.h"
#include "work.h"

#include <pcl_flashreg/estimator.h>

#include <cstddef>
#include <optional>
#include <string>

namespace pcl_flashreg::benchmark {

/** \brief What is measured on a device alone. */
struct DeviceFigures {
  /** \brief Wall-clock time, ms, of one call whose correspondences, prepared, lie on the
   * device already: from there to the pose and the inliers in host memory. */
  Spread resident_ms;
  /** \brief What one estimator takes of the device's memory, in the end, which is when it
   * takes most. */
  std::size_t memory_bytes = 0;
  /** \brief Energy of the whole board a call, correspondences resident, idle power not
   * subtracted. Nothing where NVML can't tell. */
  std::optional<double> energy_mj;
  /** \brief Nothing for problems too large to count their work on the host. */
  std::optional<Work> work;
};

/** \brief How much is measured. */
struct DeviceEffort {
  /** \brief Of the resident call. */
  Repetition repetition;
  /** \brief 0: energy is not measured. */
  double energy_seconds = 0;
};

/** \throws BackendError */
DeviceFigures
measureOnDevice(const CorrespondenceView<double>& correspondences,
                const Parameters& parameters,
                const DeviceEffort& effort);

/** \brief What the driver calls the device.
 * \throws BackendError */
std::string
deviceName();

} // namespace pcl_flashreg::benchmark
